// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/folder.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

/**
 * @file
 * The folder of results: files are written as a whole or not at all, and failures are errors on all
 * ranks together.
 */

namespace Touchstone
{
  namespace
  {
    /**
     * Throw an OutputError with the text of the system's error @p code and a remedy for the common
     * ones: full disk or quota, a folder that has been removed.
     */
    [[noreturn]] void
    fail(const std::string &path, const int code)
    {
      std::string remedy =
        "Check the folder, or choose another one with --output DIR or \"Output/Directory\".";
      if (code == ENOSPC || code == EDQUOT)
        remedy = "Free space, write fewer pictures (\"Output/VTU interval\"), or choose another "
                 "folder with --output DIR.";
      else if (code == ENOENT)
        remedy = "Was the folder removed during the run? Start again, with --output DIR to write "
                 "elsewhere.";
      throw OutputError(path, code != 0 ? std::strerror(code) : "unknown error", remedy);
    }
  } // namespace



  OutputError::OutputError(const std::string &path,
                           const std::string &reason,
                           const std::string &remedy)
    : std::runtime_error("Cannot write " + path + ": " + reason + ". " + remedy)
  {
  }



  OutputError::OutputError(const std::string &message)
    : std::runtime_error(message)
  {
  }



  TextInParts
  whole(std::string text)
  {
    // Empty when it is asked for again.
    return [text = std::move(text)]() mutable { return std::exchange(text, {}); };
  }



  void
  write_file_atomically(const std::string &path, const std::string &contents)
  {
    write_file_atomically(path, whole(contents));
  }



  void
  write_file_atomically(const std::string &path, const TextInParts &next_part)
  {
    // Written under another name and renamed, which is atomic within a file system: readers see the
    // old file or the complete new one, also if the run dies in between.
    const std::string temporary = path + ".part";

    errno = 0;
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    for (std::string part; out && !(part = next_part()).empty();)
      {
        errno = 0;
        out.write(part.data(), static_cast<std::streamsize>(part.size()));
        // The stream buffers: a full disk shows only when it is flushed and closed.
        out.flush();
      }
    if (out)
      out.close();
    if (!out)
      {
        // errno must be read before close(), which may change it. The incomplete file is removed;
        // if that fails, too, the first error is the one to report.
        const int code = errno;
        out.close();
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        fail(path, code);
      }

    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error)
      {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        fail(path, error.value());
      }
  }



  OutputFolder::OutputFolder(const std::string &directory, const MPI_Comm communicator)
    : directory(directory.empty() ? "." : directory)
    , communicator(communicator)
    , rank(dealii::Utilities::MPI::this_mpi_process(communicator))
    , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
  {
    together([this]() {
      if (rank != 0)
        return;
      std::error_code error;
      std::filesystem::create_directories(this->directory, error);
      // create_directories() reports no error if a file of that name exists.
      if (!error && !std::filesystem::is_directory(this->directory))
        error = std::make_error_code(std::errc::not_a_directory);
      if (error)
        throw OutputError("to the folder " + this->directory,
                          error.message(),
                          "Choose another folder with --output DIR or \"Output/Directory\".");

      // Only writing tells that files can be written: permission bits know nothing of read-only or
      // full file systems. Better now than after the first step.
      const std::string probe = path(".touchstone_write_test");
      Touchstone::write_file_atomically(probe, "test\n");
      std::filesystem::remove(probe, error);
    });
  }



  std::string
  OutputFolder::path(const std::string &name) const
  {
    return (std::filesystem::path(directory) / name).string();
  }



  void
  OutputFolder::write_file_atomically(const std::string &name, const std::string &contents) const
  {
    together([&]() {
      if (rank == 0)
        Touchstone::write_file_atomically(path(name), contents);
    });
  }



  void
  OutputFolder::write_pieces_atomically(const std::string &name, const TextInParts &contents) const
  {
    together([&]() { Touchstone::write_file_atomically(path(name), contents); });
  }



  void
  OutputFolder::remove_earlier(
    const std::function<bool(const std::filesystem::directory_entry &)> &are_left) const
  {
    // Collective, so that no rank writes before rank 0 has looked.
    together([&] {
      if (rank != 0)
        return;
      namespace fs = std::filesystem;
      std::error_code       error;
      std::vector<fs::path> left;
      for (const fs::directory_entry &entry : fs::directory_iterator(directory, error))
        if (are_left(entry))
          left.push_back(entry.path());
      for (const fs::path &path : left)
        if (!error && !fs::remove(path, error) && error)
          throw OutputError(path.string(),
                            error.message(),
                            "It is of an earlier run and would be taken for a result of this one: "
                            "remove it, or choose another folder with --output DIR.");
    });
  }



  void
  OutputFolder::together(const std::function<void()> &action) const
  {
    // Each rank reports whether its part succeeded, then all throw or none: an exception on one
    // rank alone would leave the others in their next collective call. The message is that of the
    // first rank that failed.
    std::string message;
    try
      {
        action();
      }
    catch (const OutputError &error)
      {
        message = error.what();
      }

    // The lowest rank that failed; the number of ranks if none did.
    const unsigned int first_failed =
      dealii::Utilities::MPI::min(message.empty() ? n_ranks : rank, communicator);
    if (first_failed < n_ranks)
      throw OutputError(dealii::Utilities::MPI::broadcast(communicator, message, first_failed));
  }
} // namespace Touchstone
