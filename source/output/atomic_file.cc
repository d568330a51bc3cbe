// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace quoin
{
  namespace
  {
    constexpr std::size_t buffer_size = 1 << 18;

    std::string cure_for(const int error_number)
    {
      switch (error_number)
      {
      case ENOSPC:
      case EDQUOT:
      case EFBIG:
        return "Free some space or choose another output directory, then "
               "go on with --resume.";
      case EACCES:
      case EPERM:
      case EROFS:
        return "Choose an output directory that may be written.";
      case ENOENT:
      case ENOTDIR:
      case EISDIR:
      case EEXIST:
        return "Choose an output directory whose path leads through "
               "directories only and is not in use for something else.";
      default:
        return "Check the disk and the output directory.";
      }
    }
  } // namespace

  std::uint32_t crc32(const std::uint32_t so_far, const char *data,
                      std::size_t n)
  {
    return ::crc32_z(so_far, reinterpret_cast<const Bytef *>(data), n);
  }

  std::string write_failure(const std::string &path, const int error_number)
  {
    return "The file '" + path + "' could not be written: "
           + (error_number != 0 ? std::strerror(error_number)
                                : "the stream failed")
           + ". " + cure_for(error_number);
  }

  void make_directory(const std::string &path)
  {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!error && !std::filesystem::is_directory(path, error) && !error)
      error = std::make_error_code(std::errc::not_a_directory);
    if (error)
      throw RunError("The directory '" + path + "' could not be made: "
                     + error.message() + ". " + cure_for(error.value()));
  }

  void sync_directory(const std::string &path)
  {
    // Failure is not an error: without it the rename is still atomic in any
    // crash but that of the machine.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY);
    if (descriptor >= 0)
    {
      ::fsync(descriptor);
      ::close(descriptor);
    }
  }

  FileBuffer::FileBuffer(const std::string &path, const bool append)
    : buffer(buffer_size)
  {
    descriptor = ::open(
        path.c_str(),
        O_WRONLY | O_CREAT | O_CLOEXEC | (append ? O_APPEND : O_TRUNC), 0666);
    if (descriptor < 0)
      first_error = errno;
    setp(buffer.data(), buffer.data() + buffer.size());
  }

  FileBuffer::~FileBuffer()
  {
    close(false);
  }

  bool FileBuffer::write_all(const char *data, std::size_t n)
  {
    while (n > 0 && first_error == 0)
    {
      const ssize_t done = ::write(descriptor, data, n);
      if (done < 0)
      {
        if (errno != EINTR)
          first_error = errno;
        continue;
      }
      crc = crc32(crc, data, done);
      n_written += done;
      data += done;
      n -= done;
    }
    return first_error == 0;
  }

  bool FileBuffer::drain()
  {
    const bool ok = write_all(pbase(), pptr() - pbase());
    setp(buffer.data(), buffer.data() + buffer.size());
    return ok;
  }

  FileBuffer::int_type FileBuffer::overflow(const int_type c)
  {
    if (!drain())
      return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof()))
      sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  std::streamsize FileBuffer::xsputn(const char *data, const std::streamsize n)
  {
    if (n > epptr() - pptr())
    {
      if (!drain())
        return 0;
      // Data that do not fit bypass the buffer.
      if (n >= static_cast<std::streamsize>(buffer.size()))
        return write_all(data, n) ? n : 0;
    }
    std::copy_n(data, n, pptr()); // memcpy refuses the null of an empty array
    pbump(static_cast<int>(n));
    return n;
  }

  int FileBuffer::sync()
  {
    return drain() ? 0 : -1;
  }

  bool FileBuffer::sync_to_disk()
  {
    drain();
    // Pipes and devices such as /dev/null cannot be synchronised (EINVAL).
    if (first_error == 0 && ::fsync(descriptor) != 0 && errno != EINVAL)
      first_error = errno;
    return first_error == 0;
  }

  bool FileBuffer::close(const bool to_disk)
  {
    if (descriptor >= 0)
    {
      if (to_disk)
        sync_to_disk();
      else
        drain();
      if (::close(descriptor) != 0 && first_error == 0)
        first_error = errno;
      descriptor = -1;
    }
    return first_error == 0;
  }

  AtomicFile::AtomicFile(const std::string &path)
    : path(path), buffer(std::make_unique<FileBuffer>(path + ".tmp")),
      out(buffer.get())
  {
    if (buffer->error() != 0)
      throw RunError(write_failure(path, buffer->error()));
  }

  AtomicFile::~AtomicFile()
  {
    if (!committed)
    {
      buffer->close(false);
      std::remove((path + ".tmp").c_str());
    }
  }

  void AtomicFile::commit(const bool to_disk)
  {
    const bool stream_is_good = out.good();
    if (!buffer->close(to_disk) || !stream_is_good)
      throw RunError(write_failure(path, buffer->error()));
    if (std::rename((path + ".tmp").c_str(), path.c_str()) != 0)
      throw RunError(write_failure(path, errno));
    committed = true;
  }

  void write_text(const std::string &path, const std::string &text)
  {
    AtomicFile file(path);
    file.stream() << text;
    file.commit();
  }
} // namespace quoin
