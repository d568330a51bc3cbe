// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/output/vtu_writer.h>

#include <cstring>

using namespace quoin;

namespace
{
  /** A reader that knows only what the VTK file format says. */
  class VtuReader
  {
  public:
    explicit VtuReader(const std::string &path)
      : text(contents(path)),
        data_begin(text.find("<AppendedData encoding=\"raw\">"))
    {
      data_begin = text.find('_', data_begin) + 1;
    }

    std::string tag(const std::string &name) const
    {
      const std::size_t at    = text.find("Name=\"" + name + "\"");
      const std::size_t begin = text.rfind('<', at);
      return at == std::string::npos
                 ? ""
                 : text.substr(begin, text.find('>', at) - begin);
    }

    static std::string attribute(const std::string &tag,
                                 const std::string &name)
    {
      const std::size_t at = tag.find(" " + name + "=\"");
      if (at == std::string::npos)
        return "";
      const std::size_t begin = at + name.size() + 3;
      return tag.substr(begin, tag.find('"', begin) - begin);
    }

    template <typename T>
    std::vector<T> array(const std::string &name, const std::string &type) const
    {
      EXPECT_EQ(attribute(tag(name), "type"), type) << name;
      const std::size_t offset = std::stoul(attribute(tag(name), "offset"));
      std::uint64_t size;
      std::memcpy(&size, text.data() + data_begin + offset, sizeof(size));
      std::vector<T> values(size / sizeof(T));
      if (size > 0)
        std::memcpy(values.data(),
                    text.data() + data_begin + offset + sizeof(size), size);
      return values;
    }

    std::string text;
    std::size_t data_begin;
  };

  VtuGrid two_triangles()
  {
    VtuGrid grid;
    grid.time      = 0.1;
    grid.cell_type = VtuCellType::triangle;
    grid.points    = { 0., 0., 1., 0., 1., 1. / 3., 0., 1. };
    grid.cells     = { 0, 1, 2, 0, 2, 3 };
    grid.point_data
        = { { "u", 2, std::vector<double>{ 1, 2, 3, 4, 5, 6, 7, 8 } },
            { "state", 1, std::vector<std::uint8_t>{ 0, 1, 2, 3 } } };
    grid.cell_data = { { "stress",
                         4,
                         std::vector<double>{ 1, 2, 3, 4, 5, 6, 7, 8 },
                         { "xx", "yy", "xy", "zz" } },
                       { "block", 1, std::vector<std::int32_t>{ -1, 70000 } } };
    return grid;
  }
} // namespace

TEST(VtuWriter, RoundTrip)
{
  const TemporaryDirectory directory;
  const std::string path = directory / "grid.vtu";
  write_vtu(path, two_triangles());

  const VtuReader reader(path);
  EXPECT_NE(reader.text.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""),
            std::string::npos);
  EXPECT_NE(reader.text.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_EQ(reader.array<double>("TimeValue", "Float64"),
            std::vector<double>({ 0.1 }));
  EXPECT_EQ(reader.array<double>("Points", "Float64"),
            std::vector<double>({ 0, 0, 0, 1, 0, 0, 1, 1. / 3., 0, 0, 1, 0 }));
  EXPECT_EQ(reader.array<std::int32_t>("connectivity", "Int32"),
            two_triangles().cells);
  EXPECT_EQ(reader.array<std::int32_t>("offsets", "Int32"),
            std::vector<std::int32_t>({ 3, 6 }));
  EXPECT_EQ(reader.array<std::uint8_t>("types", "UInt8"),
            std::vector<std::uint8_t>({ 5, 5 }));
  EXPECT_EQ(reader.array<double>("u", "Float64"),
            std::vector<double>({ 1, 2, 0, 3, 4, 0, 5, 6, 0, 7, 8, 0 }));
  EXPECT_EQ(reader.attribute(reader.tag("u"), "NumberOfComponents"), "3");
  EXPECT_EQ(reader.array<std::uint8_t>("state", "UInt8"),
            std::vector<std::uint8_t>({ 0, 1, 2, 3 }));
  EXPECT_EQ(reader.array<double>("stress", "Float64"),
            std::vector<double>({ 1, 2, 3, 4, 5, 6, 7, 8 }));
  EXPECT_EQ(reader.attribute(reader.tag("stress"), "ComponentName2"), "xy");
  EXPECT_EQ(reader.array<std::int32_t>("block", "Int32"),
            std::vector<std::int32_t>({ -1, 70000 }));
  EXPECT_FALSE(std::filesystem::exists(path + ".tmp"));

  const std::string end = "\n</AppendedData>\n</VTKFile>\n";
  EXPECT_EQ(reader.text.substr(reader.text.size() - end.size()), end);
}

TEST(VtuWriter, ATetrahedron)
{
  const TemporaryDirectory directory;
  VtuGrid grid;
  grid.dimension = 3;
  grid.cell_type = VtuCellType::tetrahedron;
  grid.points    = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  grid.cells     = { 0, 1, 2, 3 };
  grid.point_data
      = { { "u", 3,
            std::vector<double>{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 } } };
  const VtuGrid same = grid;
  write_vtu(directory / "grid.vtu", std::move(grid));
  const VtuReader reader(directory / "grid.vtu");
  EXPECT_NE(reader.text.find("NumberOfPoints=\"4\" NumberOfCells=\"1\""),
            std::string::npos);
  EXPECT_EQ(reader.array<double>("Points", "Float64"), same.points);
  EXPECT_EQ(reader.array<std::int32_t>("connectivity", "Int32"), same.cells);
  EXPECT_EQ(reader.array<std::int32_t>("offsets", "Int32"),
            std::vector<std::int32_t>({ 4 }));
  EXPECT_EQ(reader.array<std::uint8_t>("types", "UInt8"),
            std::vector<std::uint8_t>({ 10 }));
  EXPECT_EQ(reader.array<double>("u", "Float64").back(), 12.);
}

TEST(VtuWriter, AnEmptyGridIsValid)
{
  const TemporaryDirectory directory;
  VtuGrid grid;
  grid.cell_type  = VtuCellType::line;
  grid.point_data = { { "u", 2, std::vector<double>{} } };
  write_vtu(directory / "empty.vtu", grid);
  const VtuReader reader(directory / "empty.vtu");
  EXPECT_TRUE(reader.array<double>("Points", "Float64").empty());
  EXPECT_TRUE(reader.array<std::uint8_t>("types", "UInt8").empty());
}

TEST(VtuWriter, AFieldThatDoesNotFitIsRefused)
{
  const TemporaryDirectory directory;
  VtuGrid grid             = two_triangles();
  grid.cell_data[1].values = std::vector<std::int32_t>{ 1 };
  EXPECT_THROW(write_vtu(directory / "grid.vtu", grid), std::logic_error);
}

TEST(VtuWriter, UnwritableDirectory)
{
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "not a directory";
  const std::string message = message_of<RunError>(
      [&]() { write_vtu(directory / "file/grid.vtu", two_triangles()); });
  EXPECT_NE(message.find("file/grid.vtu"), std::string::npos) << message;
  EXPECT_NE(message.find("Choose"), std::string::npos) << message;
}

TEST(VtuWriter, FullDisk)
{
  const TemporaryDirectory directory;
  std::filesystem::create_symlink("/dev/full", directory / "grid.vtu.tmp");
  const std::string message = message_of<RunError>(
      [&]() { write_vtu(directory / "grid.vtu", two_triangles()); });
  EXPECT_NE(message.find("Free some space"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(directory / "grid.vtu"));
}
