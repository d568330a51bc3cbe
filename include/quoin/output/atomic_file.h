// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_atomic_file_h
#define quoin_output_atomic_file_h

#include <cstdint>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * The sentence for a file that could not be written: its name, the system's
   * reason and the cure that fits the reason. @p error_number is errno.
   */
  std::string write_failure(const std::string &path, const int error_number);

  /** Makes a directory and its parents. @throws RunError */
  void make_directory(const std::string &path);

  /** Synchronises a directory's entries with the disk. */
  void sync_directory(const std::string &path);

  /**
   * A stream buffer over a file descriptor. Unlike std::filebuf it keeps the
   * system's reason for a failure, can synchronise with the disk, and counts
   * and checks (CRC-32) the bytes.
   */
  class FileBuffer : public std::streambuf
  {
  public:
    /** Opens a new file, or the end of the present one; see error(). */
    explicit FileBuffer(const std::string &path, const bool append = false);
    ~FileBuffer() override;
    FileBuffer(const FileBuffer &)            = delete;
    FileBuffer &operator=(const FileBuffer &) = delete;

    /** errno of the first failure, 0: none. */
    int error() const
    {
      return first_error;
    }
    std::uint64_t n_bytes() const
    {
      return n_written + static_cast<std::uint64_t>(pptr() - pbase());
    }
    /** CRC-32 of all bytes flushed since the file was opened. */
    std::uint32_t checksum() const
    {
      return crc;
    }
    /** Flushes, synchronises with the disk if @p to_disk, and closes. */
    bool close(const bool to_disk);
    /** Flushes and waits until the data are on the disk. */
    bool sync_to_disk();

  protected:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char *data, std::streamsize n) override;
    int sync() override;

  private:
    bool drain();
    bool write_all(const char *data, std::size_t n);

    int descriptor          = -1;
    int first_error         = 0;
    std::uint64_t n_written = 0;
    std::uint32_t crc       = 0;
    std::vector<char> buffer;
  };

  /** Continues a CRC-32 (the one of zlib and Ethernet) over @p n bytes. */
  std::uint32_t crc32(const std::uint32_t so_far, const char *data,
                      const std::size_t n);

  /**
   * A file that appears complete or not at all: written beside its place
   * under the name FILE.tmp and renamed by commit(). Without commit() the
   * temporary file is removed.
   */
  class AtomicFile
  {
  public:
    /** @throws RunError if the file cannot be opened */
    explicit AtomicFile(const std::string &path);
    ~AtomicFile();

    std::ostream &stream()
    {
      return out;
    }

    /**
     * Renames the file to its name, if @p to_disk only when its data are on the
     * disk. @throws RunError if any of it could not be written
     */
    void commit(const bool to_disk = false);

  private:
    std::string path;
    std::unique_ptr<FileBuffer> buffer;
    std::ostream out;
    bool committed = false;
  };

  /** Writes an AtomicFile. @throws RunError */
  void write_text(const std::string &path, const std::string &text);
} // namespace quoin

#endif
