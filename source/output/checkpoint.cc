// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/collective.h>
#include <quoin/output/csv_table.h>

#include <boost/archive/archive_exception.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace quoin
{
  namespace
  {
    namespace fs = std::filesystem;

    struct ArchiveRecord
    {
      std::uint64_t size = 0; /**< [bytes] */
      std::uint64_t crc  = 0;
    };

    struct Manifest
    {
      CheckpointInfo info;
      std::string directory;
      std::vector<ArchiveRecord> archives; /**< archive of each rank */
    };

    const std::string first_words = "quoin checkpoint, format ";
    /** Format of archives and manifest; increase it when contents change. */
    constexpr unsigned int format = 26;

    fs::path root_of(const std::string &output_directory)
    {
      return fs::path(output_directory) / "checkpoint";
    }

    fs::path archive_name(const int rank)
    {
      return "rank_" + std::to_string(rank) + ".bin";
    }

    void write_manifest(const fs::path &path, const Manifest &manifest)
    {
      AtomicFile file(path.string());
      std::ostream &out = file.stream();
      out << first_words << format << "\nversion " << manifest.info.version
          << "\nstep " << manifest.info.step << "\ntime "
          << shortest_text(manifest.info.time) << "\nparameters "
          << manifest.info.parameters << "\ndirectory " << manifest.directory
          << "\nranks " << manifest.archives.size() << "\n";
      for (const ArchiveRecord &archive : manifest.archives)
        out << "archive " << archive.size << " " << archive.crc << "\n";
      out << "end\n";
      file.commit(true);
    }

    /**
     * False if the file does not exist, is not a manifest, is incomplete, or
     * has another format.
     */
    bool read_manifest(const fs::path &path, Manifest &manifest)
    {
      std::ifstream in(path);
      std::string line;
      // Each line is a key and, to its end, a value.
      const auto value = [&](const std::string &key)
      {
        if (!std::getline(in, line) || line.compare(0, key.size(), key) != 0)
        {
          in.setstate(std::ios::failbit);
          return std::string();
        }
        return line.substr(std::min(key.size() + 1, line.size()));
      };
      if (!std::getline(in, line)
          || line != first_words + std::to_string(format))
        return false;
      std::size_t n_ranks = 0;

      manifest.info.version = value("version");
      std::istringstream(value("step")) >> manifest.info.step;
      std::istringstream(value("time")) >> manifest.info.time;
      manifest.info.parameters = value("parameters");
      manifest.directory       = value("directory");
      std::istringstream(value("ranks")) >> n_ranks;
      manifest.archives.clear();
      for (std::size_t rank = 0; rank < n_ranks && in; ++rank)
      {
        ArchiveRecord archive;
        std::istringstream(value("archive")) >> archive.size >> archive.crc;
        manifest.archives.push_back(archive);
      }
      value("end");
      return static_cast<bool>(in);
    }

    /** Whether @p path is a manifest of another format than this one. */
    bool has_other_format(const fs::path &path)
    {
      std::ifstream in(path);
      std::string line;
      return std::getline(in, line) && line.rfind(first_words, 0) == 0
             && line != first_words + std::to_string(format);
    }

    /** Whether a directory beside the manifest is one of a checkpoint. */
    bool is_of_checkpoint(const std::string &name)
    {
      const auto end         = name.find_first_not_of("0123456789");
      const std::string rest = end == std::string::npos ? "" : name.substr(end);
      return end != 0 && (rest.empty() || rest == ".tmp" || rest == "-again");
    }

    /** A name that the valid checkpoint does not use. */
    std::string directory_for(const std::uint64_t step, const fs::path &root)
    {
      Manifest manifest;
      const std::string name = std::to_string(step);
      return read_manifest(root / "latest", manifest)
                     && manifest.directory == name
                 ? name + "-again"
                 : name;
    }

    ArchiveRecord
    write_archive(const fs::path &path,
                  const std::function<void(std::streambuf &)> &write)
    {
      FileBuffer buffer(path.string());
      if (buffer.error() == 0)
        try
        {
          write(buffer);
        }
        catch (const boost::archive::archive_exception &)
        {
          // Boost only reports a failure; the buffer has the reason.
          if (buffer.error() == 0)
            throw;
        }
      if (!buffer.close(true))
        throw RunError(write_failure(path.string(), buffer.error()));
      return { buffer.n_bytes(), buffer.checksum() };
    }

    ArchiveRecord record_of(const fs::path &path)
    {
      ArchiveRecord record;
      std::ifstream in(path, std::ios::binary);
      std::vector<char> chunk(1 << 20);
      std::uint32_t crc = 0;
      while (in.read(chunk.data(), chunk.size()) || in.gcount() > 0)
      {
        record.size += in.gcount();
        crc = crc32(crc, chunk.data(), in.gcount());
      }
      record.crc = crc;
      return record;
    }

    void examine(const fs::path &path, const ArchiveRecord &expected)
    {
      const ArchiveRecord found = record_of(path);
      if (found.size != expected.size || found.crc != expected.crc)
        throw InputError("The checkpoint file '" + path.string()
                         + "' is damaged (" + std::to_string(found.size)
                         + " of " + std::to_string(expected.size) + " bytes"
                         + (found.size == expected.size
                                ? ", but their checksum is wrong"
                                : "")
                         + "): start the run without --resume.");
    }

    void rename_directory(const fs::path &from, const fs::path &to)
    {
      sync_directory(from.string());
      if (std::rename(from.c_str(), to.c_str()) != 0)
        throw RunError(write_failure(to.string(), errno));
      sync_directory(to.parent_path().string());
    }

    void remove_others(const fs::path &root, const std::string &keep)
    {
      // Older checkpoints that cannot be removed only take space.
      std::error_code error;
      std::vector<fs::path> old;
      for (const fs::directory_entry &entry :
           fs::directory_iterator(root, error))
        if (entry.is_directory(error) && entry.path().filename() != keep
            && is_of_checkpoint(entry.path().filename()))
          old.push_back(entry.path());
      for (const fs::path &path : old)
        fs::remove_all(path, error);
    }

    /** Checks that need no archive. */
    Manifest acceptable_manifest(const std::string &output_directory,
                                 const std::string &version,
                                 const std::string &parameters,
                                 const std::string &changes)
    {
      const fs::path root     = root_of(output_directory);
      const std::string where = "The checkpoint in '" + root.string() + "' ";
      const std::string fresh = "start the run without --resume.";
      if (!checkpoint_exists(output_directory))
        throw InputError("There is no checkpoint in '" + root.string()
                         + "' to resume from: " + fresh);
      if (has_other_format(root / "latest"))
        throw InputError(where
                         + "was written by another version of the program, "
                           "whose checkpoints differ: use that one or "
                         + fresh);
      Manifest manifest;
      if (!read_manifest(root / "latest", manifest))
        throw InputError(where + "cannot be used, because its file 'latest' "
                         + "is damaged: " + fresh);
      if (manifest.info.version != version)
        throw InputError(where + "was written by version "
                         + manifest.info.version + " and this is version "
                         + version + ": use that version or " + fresh);
      if (manifest.info.parameters != parameters)
        throw InputError(where
                         + (changes.empty()
                                ? std::string("belongs to another mesh, table "
                                              "or record than that of this run")
                                : "belongs to other parameters: " + changes)
                         + ". Use the same ones or " + fresh);
      return manifest;
    }
  } // namespace

  std::string fingerprint(const std::string &text)
  {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : text)
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    char hex[17];
    std::snprintf(hex, sizeof(hex), "%016llx",
                  static_cast<unsigned long long>(hash));
    return hex;
  }

  bool checkpoint_exists(const std::string &output_directory)
  {
    std::error_code error;
    return fs::exists(root_of(output_directory) / "latest", error);
  }

  void remove_checkpoint(const std::string &output_directory)
  {
    const fs::path root = root_of(output_directory);
    std::error_code error;
    // The manifest is removed first: without it the rest is not a checkpoint.
    for (const char *name : { "latest", "latest.tmp" })
      fs::remove(root / name, error);
    remove_others(root, "");
    fs::remove(root, error); // unless it has other contents
  }

  void
  save_checkpoint_archives(const std::string &output_directory,
                           const MPI_Comm communicator,
                           const CheckpointInfo &info,
                           const std::function<void(std::streambuf &)> &write)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    const fs::path root  = root_of(output_directory);
    const fs::path aside = root / (std::to_string(info.step) + ".tmp");

    // 1. An empty directory under a temporary name.
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (rank == 0)
                            {
                              std::error_code error;
                              fs::remove_all(aside, error);
                              make_directory(aside.string());
                            }
                          });

    // 2. The archives, on the disk.
    ArchiveRecord mine;
    all_or_none<RunError>(
        communicator,
        [&]() { mine = write_archive(aside / archive_name(rank), write); });
    std::vector<ArchiveRecord> all(n_ranks);
    MPI_Gather(&mine, 2, MPI_UINT64_T, all.data(), 2, MPI_UINT64_T, 0,
               communicator);

    // 3. Directory and manifest in their places; from here on it is valid.
    all_or_none<RunError>(
        communicator,
        [&]()
        {
          if (rank == 0)
          {
            const std::string name = directory_for(info.step, root);
            std::error_code error;
            fs::remove_all(root / name, error);
            rename_directory(aside, root / name);
            write_manifest(root / "latest", { info, name, all });
            sync_directory(root.string());
            remove_others(root, name);
          }
        });
  }

  CheckpointInfo load_checkpoint_archives(
      const std::string &output_directory, const MPI_Comm communicator,
      const std::string &version, const std::string &parameters,
      const std::function<void(std::streambuf &, const ArchiveOrigin &)> &read,
      const std::string &changes)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);

    // 1. All archives are checked before any is read.
    Manifest manifest;
    const auto path_of = [&](const unsigned int writer)
    {
      return root_of(output_directory) / manifest.directory
             / archive_name(writer);
    };
    all_or_none<InputError>(
        communicator,
        [&]()
        {
          manifest = acceptable_manifest(output_directory, version, parameters,
                                         changes);
          for (unsigned int writer = rank; writer < manifest.archives.size();
               writer += n_ranks)
            examine(path_of(writer), manifest.archives[writer]);
        });

    // 2. The contents.
    const unsigned int n_writers = manifest.archives.size();
    const auto read_archive      = [&](const ArchiveOrigin &origin)
    {
      all_or_none<InputError>(
          communicator,
          [&]()
          {
            const fs::path path = path_of(origin.rank);
            std::filebuf buffer;
            buffer.open(path, std::ios::in | std::ios::binary);
            try
            {
              read(buffer, origin);
            }
            // Errors of the archive, or of array sizes that do not fit.
            catch (const std::exception &error)
            {
              throw InputError("The checkpoint file '" + path.string()
                               + "' cannot be read (" + error.what()
                               + "): start the run without --resume.");
            }
          });
    };
    if (n_writers == static_cast<unsigned int>(n_ranks))
      read_archive({ static_cast<unsigned int>(rank), n_writers, true });
    else
      for (unsigned int writer = n_writers; writer-- > 0;)
        read_archive({ writer, n_writers, false });
    return manifest.info;
  }
} // namespace quoin
