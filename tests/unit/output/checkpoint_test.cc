// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "temporary_directory.h"

#include <quoin/joints/joint_history.h>
#include <quoin/operators/state.h>
#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/field_series.h>

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <set>

using namespace quoin;

namespace
{
  const std::string version    = "1.2.3 (test)";
  const std::string parameters = fingerprint("set A = 1");

  State<2> example_state(const std::size_t n)
  {
    State<2> state;
    state.time = 0.1;
    state.step = 42;
    state.nodes.resize(n);
    state.velocity.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      state.nodes[i]    = { { 1. / (i + 1.), -0.3 * i },
                            dealii::Point<2>(1e-17 * i, 5e-324) };
      state.velocity[i] = dealii::Point<2>(std::sqrt(i + 2.), -0.);
    }
    JointHistory &joints = state.add<JointHistory>();
    joints.resize(n / 2, 3);
    for (std::size_t i = 0; i < n / 2; ++i)
    {
      joints.normal_traction[i] = -1e6 / (i + 3.);
      joints.state[i]           = static_cast<JointState>(i % 4);
      for (unsigned int k = 0; k < 3; ++k)
        joints.internal[k][i] = 0.1 * i - k;
    }
    state.energy.friction = 1. / 7.;
    return state;
  }

  CheckpointInfo info_at(const std::uint64_t step)
  {
    CheckpointInfo info;
    info.step       = step;
    info.time       = 0.1;
    info.version    = version;
    info.parameters = parameters;
    return info;
  }

  template <typename T>
  bool same_bytes(const AlignedArray<T> &a, const AlignedArray<T> &b)
  {
    return a.size() == b.size()
           && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
  }

  std::string refusal(const TemporaryDirectory &directory,
                      const std::string &other_version    = version,
                      const std::string &other_parameters = parameters)
  {
    return message_of<InputError>(
        [&]()
        {
          State<2> state = example_state(0);
          load_checkpoint(directory.path(), MPI_COMM_SELF, other_version,
                          other_parameters, state);
        });
  }

  void expect_mention(const std::string &message, const std::string &words)
  {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
} // namespace

TEST(Checkpoint, Crc32IsTheUsualOne)
{
  const std::string digits = "123456789";
  EXPECT_EQ(crc32(0, digits.data(), 9), 0xCBF43926U);
  EXPECT_EQ(crc32(crc32(0, digits.data(), 4), digits.data() + 4, 5),
            0xCBF43926U);
}

TEST(Checkpoint, RoundTripIsBitwise)
{
  const TemporaryDirectory directory;
  const State<2> before = example_state(100001);
  EXPECT_FALSE(checkpoint_exists(directory.path()));
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(42), before);
  EXPECT_TRUE(checkpoint_exists(directory.path()));

  State<2> after            = example_state(0);
  const CheckpointInfo info = load_checkpoint(directory.path(), MPI_COMM_SELF,
                                              version, parameters, after);
  EXPECT_EQ(info.step, 42U);
  EXPECT_EQ(info.time, 0.1);
  EXPECT_EQ(after.time, before.time);
  EXPECT_EQ(after.step, before.step);
  EXPECT_EQ(after.energy.friction, before.energy.friction);
  EXPECT_TRUE(same_bytes(after.nodes, before.nodes));
  EXPECT_TRUE(same_bytes(after.velocity, before.velocity));
  EXPECT_TRUE(same_bytes(after.get<JointHistory>().normal_traction,
                         before.get<JointHistory>().normal_traction));
  EXPECT_TRUE(same_bytes(after.get<JointHistory>().state,
                         before.get<JointHistory>().state));
  for (unsigned int k = 0; k < JointHistory::most_internal; ++k)
  {
    const auto &kept = after.get<JointHistory>().internal[k];
    EXPECT_EQ(kept.size(), k < 3 ? before.nodes.size() / 2 : 0U);
    EXPECT_TRUE(same_bytes(kept, before.get<JointHistory>().internal[k]));
  }
}

TEST(Checkpoint, OnlyTheNewestIsKept)
{
  const TemporaryDirectory directory;
  for (const std::uint64_t step : { 1, 2, 2, 2, 30 })
  {
    save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(step),
                    example_state(step));
    State<2> state = example_state(0);
    EXPECT_EQ(load_checkpoint(directory.path(), MPI_COMM_SELF, version,
                              parameters, state)
                  .step,
              step);
    EXPECT_EQ(state.nodes.size(), step);
  }
  unsigned int n_entries = 0;
  for ([[maybe_unused]] const auto &entry :
       std::filesystem::directory_iterator(directory / "checkpoint"))
    ++n_entries;
  EXPECT_EQ(n_entries, 2U); // 30 and latest
}

TEST(Checkpoint, AFailedOneLeavesTheOlderOneValid)
{
  const TemporaryDirectory directory;
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(1),
                  example_state(10));
  const std::string message = message_of<RunError>(
      [&]()
      {
        save_checkpoint_archives(directory.path(), MPI_COMM_SELF, info_at(2),
                                 [](std::streambuf &)
                                 { throw RunError("The disk is full."); });
      });
  EXPECT_EQ(message, "The disk is full.");
  State<2> state = example_state(0);
  EXPECT_EQ(load_checkpoint(directory.path(), MPI_COMM_SELF, version,
                            parameters, state)
                .step,
            1U);
  // The next one is not disturbed by what the failed one left.
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(2),
                  example_state(11));
  load_checkpoint(directory.path(), MPI_COMM_SELF, version, parameters, state);
  EXPECT_EQ(state.nodes.size(), 11U);
}

TEST(Checkpoint, Refusals)
{
  const TemporaryDirectory directory;
  expect_mention(refusal(directory), "There is no checkpoint");
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(1),
                  example_state(10));
  expect_mention(refusal(directory), "nothing was thrown");
  expect_mention(refusal(directory, "9.9.9"), "version 1.2.3 (test)");
  expect_mention(refusal(directory, version, "other"), "another mesh");

  const std::string latest = directory / "checkpoint/latest";
  std::string manifest     = contents(latest);
  std::ofstream(latest) << manifest.substr(0, manifest.size() - 4);
  expect_mention(refusal(directory), "'latest' is damaged");
}

TEST(Checkpoint, DamagedArchivesAreRefused)
{
  const TemporaryDirectory directory;
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(7),
                  example_state(1000));
  const std::string path    = directory / "checkpoint/7/rank_0.bin";
  const std::string archive = contents(path);
  ASSERT_GT(archive.size(), 48000U);

  std::string flipped = archive;
  flipped[20000]      = static_cast<char>(flipped[20000] ^ 1);
  std::ofstream(path, std::ios::binary) << flipped;
  expect_mention(refusal(directory), "checksum is wrong");

  std::filesystem::resize_file(path, 1000);
  expect_mention(refusal(directory), "is damaged (1000 of ");

  std::filesystem::remove(path);
  expect_mention(refusal(directory), "is damaged (0 of ");

  std::ofstream(path, std::ios::binary) << archive;
  expect_mention(refusal(directory), "nothing was thrown");
}

TEST(Checkpoint, OfAnotherNumberOfRanks)
{
  // Of three ranks, which wrote the same.
  const TemporaryDirectory directory;
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(7),
                  example_state(10));
  const std::string archive = contents(directory / "checkpoint/7/rank_0.bin");
  for (const char *name : { "1", "2" })
    std::ofstream(directory
                      / ("checkpoint/7/rank_" + std::string(name) + ".bin"),
                  std::ios::binary)
        << archive;
  const std::string latest = directory / "checkpoint/latest";
  std::string manifest     = contents(latest);
  const std::size_t at     = manifest.find("ranks 1\n");
  ASSERT_NE(at, std::string::npos);
  const std::string line
      = manifest.substr(at + 8, manifest.find("end") - at - 8);
  manifest.replace(at, 8, "ranks 3\n" + line + line);
  std::ofstream(latest) << manifest;

  std::vector<unsigned int> writers;
  const auto load = [&]()
  {
    return load_checkpoint_archives(
        directory.path(), MPI_COMM_SELF, version, parameters,
        [&](std::streambuf &buffer, const ArchiveOrigin &origin)
        {
          State<2> state = example_state(0);
          boost::archive::binary_iarchive(buffer) >> state;
          EXPECT_EQ(state.nodes.size(), 10U);
          EXPECT_EQ(origin.n_ranks, 3U);
          EXPECT_FALSE(origin.is_own);
          writers.push_back(origin.rank);
        });
  };
  EXPECT_EQ(load().step, 7U);
  EXPECT_EQ(writers, (std::vector<unsigned int>{ 2, 1, 0 }));

  // Nothing is read if one of them is damaged.
  std::filesystem::resize_file(directory / "checkpoint/7/rank_1.bin", 100);
  expect_mention(message_of<InputError>(load),
                 "rank_1.bin' is damaged (100 of");
  EXPECT_EQ(writers.size(), 3U);
}

TEST(Checkpoint, OfAnotherFormatIsRefused)
{
  const TemporaryDirectory directory;
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(1),
                  example_state(10));
  const std::string latest = directory / "checkpoint/latest";
  std::string manifest     = contents(latest);
  const std::size_t at     = manifest.find("format ");
  ASSERT_NE(at, std::string::npos);
  manifest.replace(at, manifest.find('\n') - at, "format 1");
  std::ofstream(latest) << manifest;
  expect_mention(refusal(directory), "another version of the program");
}

TEST(Checkpoint, RemovesNothingElse)
{
  const TemporaryDirectory directory;
  remove_checkpoint(directory.path()); // there is none
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(12),
                  example_state(10));
  for (const char *name : { "13.tmp", "12-again", "notes", "12b" })
    std::filesystem::create_directory(directory
                                      / ("checkpoint/" + std::string(name)));
  remove_checkpoint(directory.path());
  EXPECT_FALSE(checkpoint_exists(directory.path()));
  std::set<std::string> left;
  for (const auto &entry :
       std::filesystem::directory_iterator(directory / "checkpoint"))
    left.insert(entry.path().filename());
  EXPECT_EQ(left, (std::set<std::string>{ "12b", "notes" }));

  std::filesystem::remove_all(directory / "checkpoint");
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(12),
                  example_state(10));
  remove_checkpoint(directory.path());
  EXPECT_FALSE(std::filesystem::exists(directory / "checkpoint"));
}

TEST(Checkpoint, UnwritableDirectory)
{
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "not a directory";
  const std::string message = message_of<RunError>(
      [&]()
      {
        save_checkpoint(directory / "file", MPI_COMM_SELF, info_at(1),
                        example_state(1));
      });
  expect_mention(message, "file/checkpoint");
}

TEST(Checkpoint, OfAllRanks)
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const TemporaryDirectory directory;
  char path[1024] = "";
  directory.path().copy(path, sizeof(path) - 1);
  MPI_Bcast(path, sizeof(path), MPI_CHAR, 0, MPI_COMM_WORLD);

  save_checkpoint(path, MPI_COMM_WORLD, info_at(1), example_state(5 + rank));
  State<2> state = example_state(0);
  load_checkpoint(path, MPI_COMM_WORLD, version, parameters, state);
  EXPECT_EQ(state.nodes.size(), 5U + rank);

  // What fails on one rank fails on all of them, and nothing waits.
  const std::string message = message_of<RunError>(
      [&]()
      {
        save_checkpoint_archives(path, MPI_COMM_WORLD, info_at(2),
                                 [&](std::streambuf &)
                                 {
                                   if (rank == n_ranks - 1)
                                     throw RunError("The disk is full.");
                                 });
      });
  EXPECT_EQ(message, "The disk is full.");
  load_checkpoint(path, MPI_COMM_WORLD, version, parameters, state);
  EXPECT_EQ(state.nodes.size(), 5U + rank);
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Checkpoint, FullDiskLeavesTheOlderOneValid)
{
  const TemporaryDirectory directory;
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(1),
                  example_state(10));

  // A limit on the size of files stands for the end of the disk.
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small  = { 100000, before.rlim_max };
  auto *const handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = message_of<RunError>(
      [&]()
      {
        save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(2),
                        example_state(100000));
      });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);

  expect_mention(message, "2.tmp/rank_0.bin");
  expect_mention(message, "Free some space");
  State<2> state = example_state(0);
  load_checkpoint(directory.path(), MPI_COMM_SELF, version, parameters, state);
  EXPECT_EQ(state.nodes.size(), 10U);
}

TEST(Checkpoint, ASeriesGoesOn)
{
  class Series : public FieldSeries
  {
  public:
    explicit Series(const TemporaryDirectory &directory)
      : FieldSeries(directory.path(), "blocks", MPI_COMM_SELF, FieldFormat::vtu)
    {
    }

    void write(const double time)
    {
      write_grid({ time, VtuCellType::line, { 0., 0., 1., 0. }, { 0, 1 } });
    }
  };
  const TemporaryDirectory directory;
  Series before(directory);
  before.start();
  before.write(0.5);
  save_checkpoint(directory.path(), MPI_COMM_SELF, info_at(1), before);
  before.write(0.75);

  Series after(directory);
  load_checkpoint(directory.path(), MPI_COMM_SELF, version, parameters, after);
  after.start();
  EXPECT_EQ(after.n_written(), 1U);
  std::string text = contents(directory / "blocks.pvd");
  expect_mention(text, "timestep=\"0.5\" part=\"0\" "
                       "file=\"fields/blocks_0000_0.vtu\"");
  EXPECT_EQ(text.find("0.75"), std::string::npos) << text;
  after.write(1.);
  text = contents(directory / "blocks.pvd");
  expect_mention(text, "timestep=\"0.5\"");
  expect_mention(text, "timestep=\"1\" part=\"0\" file=\"fields/blocks_0001");
}
