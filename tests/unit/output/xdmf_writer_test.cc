// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/output/xdmf_writer.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <filesystem>
#include <sstream>

using namespace quoin;

namespace
{
  const std::string closing = "</Grid>\n</Domain>\n</Xdmf>\n";

  VtuGrid line_at(const double time, const double opening)
  {
    VtuGrid grid{ time, VtuCellType::line, { 0., 0., 1., 0. }, { 0, 1 } };
    grid.cell_data = { { "opening", 1, std::vector<double>{ opening } } };
    return grid;
  }

  unsigned int count(const std::string &text, const std::string &word)
  {
    unsigned int n = 0;
    for (auto at = text.find(word); at != std::string::npos;
         at      = text.find(word, at + 1))
      ++n;
    return n;
  }

  class XdmfWriterTest : public testing::Test
  {
  protected:
    XdmfWriter writer()
    {
      return XdmfWriter(directory.path(), "joints", MPI_COMM_SELF);
    }
    std::string text() const
    {
      return contents(directory / "joints.xdmf");
    }
    std::uintmax_t n_bytes() const
    {
      return std::filesystem::file_size(directory / "joints.bin");
    }
    const TemporaryDirectory directory;
  };
} // namespace

TEST_F(XdmfWriterTest, WritesWhatHasChanged)
{
  XdmfWriter series = writer();
  series.start();
  EXPECT_EQ(count(text(), closing), 1U);
  EXPECT_EQ(n_bytes(), 0U);

  series.write(line_at(0., 1.));
  // two numbers of points, two points of three coordinates, a value
  EXPECT_EQ(n_bytes(), 8U + 48U + 8U);
  series.write(line_at(0.5, 1.));
  EXPECT_EQ(n_bytes(), 64U);
  series.write(line_at(1., 2.));
  EXPECT_EQ(n_bytes(), 72U);
  EXPECT_EQ(count(text(), "<Time Value=\"0.5\"/>"), 1U);
  EXPECT_EQ(count(text(), "Seek=\"56\""), 2U);
  EXPECT_EQ(count(text(), "Seek=\"64\""), 1U);
  // nothing is left of the closing tags of earlier times
  EXPECT_EQ(count(text(), closing), 1U);
  EXPECT_EQ(count(text(), "</Grid>"), 2U * 3U + 1U);

  series.write({ 1.5, VtuCellType::line, {}, {} });
  EXPECT_EQ(n_bytes(), 72U);
  EXPECT_EQ(count(text(), "<Time Value=\"1.5\"/>\n</Grid>"), 1U);
}

TEST_F(XdmfWriterTest, OtherMeshesHaveOtherPaths)
{
  XdmfWriter series = writer();
  series.start();
  series.write(line_at(0., 1.));
  VtuGrid moved   = line_at(1., 1.);
  moved.points[0] = -1.;
  series.write(moved);
  // 8 is 1000 and 64 is 1000000 in binary digits, the last one first
  EXPECT_EQ(count(text(), ">./././/joints.bin<"), 0U);
  EXPECT_EQ(count(text(), ">././././/joints.bin<"), 1U);
  EXPECT_EQ(count(text(), ">./././././././/joints.bin<"), 1U);
  EXPECT_EQ(std::filesystem::file_size(directory / "./././././././/joints.bin"),
            n_bytes());
}

TEST_F(XdmfWriterTest, GoesOnFromACheckpoint)
{
  std::stringstream archive;
  std::string whole;
  {
    XdmfWriter series = writer();
    series.start();
    series.write(line_at(0., 1.));
    boost::archive::binary_oarchive(archive) << series;
    series.write(line_at(1., 2.));
    whole = text();
    series.write(line_at(2., 3.));
  }
  XdmfWriter series = writer();
  boost::archive::binary_iarchive(archive) >> series;
  series.start();
  EXPECT_EQ(n_bytes(), 64U);
  EXPECT_EQ(count(text(), "<Time"), 1U);
  EXPECT_EQ(count(text(), closing), 1U);
  series.write(line_at(1., 2.));
  EXPECT_EQ(text(), whole);
  EXPECT_EQ(n_bytes(), 72U);
}

TEST_F(XdmfWriterTest, RefusesFilesThatAreNotThoseOfTheCheckpoint)
{
  std::stringstream archive;
  XdmfWriter series = writer();
  series.start();
  series.write(line_at(0., 1.));
  boost::archive::binary_oarchive(archive) << series;
  XdmfWriter after = writer();
  boost::archive::binary_iarchive(archive) >> after;
  std::filesystem::resize_file(directory / "joints.bin", 63);
  const std::string message = message_of<InputError>([&]() { after.start(); });
  for (const char *words : { "joints.bin", "shorter", "without --resume" })
    EXPECT_NE(message.find(words), std::string::npos) << message;
  std::filesystem::remove(directory / "joints.bin");
  EXPECT_THROW(after.start(), InputError);
}

TEST_F(XdmfWriterTest, FullDisk)
{
  XdmfWriter series = writer();
  series.start();
  std::filesystem::remove(directory / "joints.bin");
  std::filesystem::create_symlink("/dev/full", directory / "joints.bin");
  const std::string message
      = message_of<RunError>([&]() { series.write(line_at(0., 1.)); });
  EXPECT_NE(message.find("joints.bin"), std::string::npos) << message;
  EXPECT_NE(message.find("space"), std::string::npos) << message;
  EXPECT_EQ(count(text(), "<Time"), 0U);
}
