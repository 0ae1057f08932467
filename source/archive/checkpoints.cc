// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/checkpoints.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <regex>
#include <sstream>
#include <unistd.h>

// Checkpoints on disk (format and order of writing: see the header). A checkpoint must be either
// complete or recognised as incomplete, whatever interrupts the program: hence durable writing, a
// rename at the end, and checksums that are verified before anything is read.
namespace Touchstone
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::string first_line = "touchstone checkpoint, format 1";
    const std::string contents = "contents", parameters_file = "parameters.prm";

    // An error that names the path and says what the user can do; all failures of writing end
    // here.
    [[noreturn]] void
    fail(const std::string &path, const int code)
    {
      throw OutputError(path,
                        std::strerror(code),
                        "The last complete checkpoint is still there. Free space, or choose "
                        "another folder with --output DIR.");
    }

    std::string
    piece_name(const unsigned int number)
    {
      return "piece_" + std::to_string(number) + ".bin";
    }

    std::string
    checksum(const char *data, const std::size_t size)
    {
      boost::crc_32_type crc;
      crc.process_bytes(data, size);
      char text[9];
      std::snprintf(text, sizeof(text), "%08x", static_cast<unsigned int>(crc.checksum()));
      return text;
    }

    /** The entry of a file in `contents`: its size in bytes and its CRC-32. */
    std::string
    size_and_checksum(const char *data, const std::size_t size)
    {
      return std::to_string(size) + " " + checksum(data, size);
    }

    /**
     * All bytes of a file. @throws std::runtime_error, which makes a candidate be skipped and
     * does not end the run.
     */
    std::vector<char>
    read(const std::string &path)
    {
      errno = 0;
      std::ifstream file(path, std::ios::binary);
      // A folder can be opened, but not be read.
      if (!file || (file.peek(), file.bad()))
        throw std::runtime_error(path +
                                 " cannot be read: " + std::strerror(errno != 0 ? errno : EIO));
      return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    /** Force the entries of a folder to the disk: fsync() of a file does not cover its name. */
    void
    synchronise(const std::string &path)
    {
      const int descriptor = open(path.c_str(), O_RDONLY | O_DIRECTORY);
      if (descriptor < 0)
        fail(path, errno);
      // Some file systems cannot do that and say EINVAL.
      if (fsync(descriptor) != 0 && errno != EINVAL)
        {
          const int code = errno;
          close(descriptor);
          fail(path, code);
        }
      close(descriptor);
    }

    /**
     * Write a file and force it to the disk. Calls of the system and not a stream, for only these
     * report errors of writing that appear late (fsync, close), as on full or remote disks.
     * write() may write a part, or be interrupted.
     */
    void
    write_durably(const std::string &path, const char *data, const std::size_t size)
    {
      const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      if (descriptor < 0)
        fail(path, errno);
      int code = 0;
      for (std::size_t done = 0; done < size && code == 0;)
        {
          const ssize_t n = ::write(descriptor, data + done, size - done);
          if (n >= 0)
            done += n;
          else if (errno != EINTR)
            code = errno;
        }
      if (code == 0 && fsync(descriptor) != 0)
        code = errno;
      if (close(descriptor) != 0 && code == 0)
        code = errno;
      if (code != 0)
        fail(path, code);
    }

    /**
     * Names of the checkpoints in a folder by their numbers, complete or not. Folders that end in
     * .part do not match: they were never complete. A folder that cannot be read has none.
     */
    std::map<unsigned int, std::string>
    list(const std::string &directory)
    {
      const std::regex                    pattern("checkpoint_([0-9]{6,9})");
      std::map<unsigned int, std::string> result;
      std::error_code                     error;
      for (const auto &entry : fs::directory_iterator(directory, error))
        {
          const std::string name = entry.path().filename().string();
          std::smatch       match;
          if (std::regex_match(name, match, pattern))
            result[std::stoul(match[1])] = name;
        }
      return result;
    }

    /** Read `contents`. @throws std::runtime_error with what is wrong with it.
     * @param files Takes what it says of each file. */
    Checkpoint
    read_contents(const std::string &folder, std::map<std::string, std::string> &files)
    {
      const std::vector<char> bytes = read((fs::path(folder) / contents).string());
      const std::string       text(bytes.begin(), bytes.end());
      // The last line is a checksum of all before it: a file that was cut off or changed is
      // noticed before its table is believed.
      const std::size_t end = text.rfind("complete ");
      if (text.compare(0, first_line.size(), first_line) != 0)
        throw std::runtime_error(text.compare(0, 21, first_line, 0, 21) == 0
                                   ? "it has another format than this program's"
                                   : "its 'contents' is damaged");
      if (end == std::string::npos ||
          text.substr(end) != "complete " + checksum(text.data(), end) + "\n")
        throw std::runtime_error("its 'contents' is damaged");

      Checkpoint         result;
      std::istringstream lines(text.substr(0, end));
      std::string        name, size, sum;
      std::getline(lines, name);
      lines >> name >> result.step >> name >> result.time >> name >> result.n_pieces;
      while (lines >> name >> size >> sum)
        files[name] = size + " " + sum;
      result.folder = folder;
      result.name   = fs::path(folder).filename().string();
      return result;
    }
  } // namespace



  std::vector<char>
  Checkpoint::piece(const unsigned int number) const
  {
    return read((fs::path(folder) / piece_name(number)).string());
  }



  std::string
  Checkpoint::parameters() const
  {
    const std::vector<char> bytes = read((fs::path(folder) / parameters_file).string());
    return std::string(bytes.begin(), bytes.end());
  }



  FoundCheckpoint
  find_checkpoint(const std::string &directory, const MPI_Comm communicator)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator),
                       n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    FoundCheckpoint result;
    // One rank lists the folder, so that all ranks try the same candidates even if another
    // program writes there in the meantime.
    std::vector<std::pair<unsigned int, std::string>> candidates;
    if (rank == 0)
      for (const auto &[number, name] : list(directory.empty() ? "." : directory))
        candidates.emplace_back(number, name);
    candidates = Utilities::MPI::broadcast(communicator, candidates, 0);
    // From the newest on; an older complete one is better than none.
    for (auto candidate = candidates.rbegin(); candidate != candidates.rend(); ++candidate)
      {
        Checkpoint  found;
        std::string problem;
        try
          {
            std::map<std::string, std::string> files;
            found = read_contents((fs::path(directory) / candidate->second).string(), files);
            // Each rank reads a share of the files, since checksums need every byte of them.
            unsigned int turn = 0;
            for (const auto &[name, expected] : files)
              if (turn++ % n_ranks == rank)
                {
                  const std::vector<char> bytes = read((fs::path(found.folder) / name).string());
                  if (size_and_checksum(bytes.data(), bytes.size()) != expected)
                    throw std::runtime_error(name + " is damaged");
                }
            if (files.size() != found.n_pieces + 1)
              throw std::runtime_error("its 'contents' is damaged");
          }
        catch (const std::runtime_error &error)
          {
            problem = error.what();
          }
        // All ranks must have found their share in order. Of several problems that of the lowest
        // rank is reported, so the message does not depend on timing.
        const unsigned int first =
          Utilities::MPI::min(problem.empty() ? n_ranks : rank, communicator);
        if (first == n_ranks)
          {
            found.number      = candidate->first;
            result.checkpoint = std::make_shared<const Checkpoint>(found);
            return result;
          }
        result.skipped.push_back("checkpoint " + candidate->second + " is skipped: " +
                                 Utilities::MPI::broadcast(communicator, problem, first));
      }
    return result;
  }



  Checkpoints::Checkpoints(const OutputFolder                      &folder,
                           const std::shared_ptr<const Checkpoint> &present)
    : folder(folder)
    // One that was read from another folder is not in this one and needs no protection.
    , previous(present ? present->name : "")
  {
    // Numbers go on behind all that are there, also damaged ones: a name is never used twice.
    if (folder.rank == 0)
      for (const auto &[number, name] : list(folder.path("")))
        last_number = std::max(last_number, number);
    last_number = Utilities::MPI::broadcast(folder.communicator, last_number, 0);
  }



  std::string
  Checkpoints::write(const std::vector<char> &piece,
                     const unsigned int       step,
                     const double             time,
                     const std::string       &parameters)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "checkpoint_%06u", ++last_number);
    const std::string name = text, part = folder.path(name + ".part");

    // Remains of an earlier attempt are removed. together() lets all ranks leave with the error
    // of one, so no rank waits in a later collective call.
    folder.together([&]() {
      if (folder.rank != 0)
        return;
      std::error_code error;
      fs::remove_all(part, error);
      fs::create_directories(part, error);
      if (error)
        fail(part, error.value());
    });
    const auto write_file = [&](const std::string &file, const char *data, const std::size_t size) {
      write_durably((fs::path(part) / file).string(), data, size);
    };
    folder.together([&]() { write_file(piece_name(folder.rank), piece.data(), piece.size()); });
    const std::vector<std::string> sums =
      Utilities::MPI::gather(folder.communicator, size_and_checksum(piece.data(), piece.size()));

    // Only when all pieces are on the disk does rank 0 write the table of contents, then the
    // folder gets its final name: rename() is atomic, so the name stands for a complete
    // checkpoint. The second synchronise() makes the name itself durable, and only then are older
    // checkpoints removed.
    folder.together([&]() {
      if (folder.rank != 0)
        return;
      std::ostringstream table;
      table.imbue(std::locale::classic());
      table << first_line << "\nstep " << step << "\ntime "
            << std::setprecision(std::numeric_limits<double>::max_digits10) << time << "\npieces "
            << sums.size() << '\n';
      for (unsigned int i = 0; i < sums.size(); ++i)
        table << piece_name(i) << ' ' << sums[i] << '\n';
      table << parameters_file << ' ' << size_and_checksum(parameters.data(), parameters.size())
            << '\n';
      std::string all = table.str();
      all += "complete " + checksum(all.data(), all.size()) + "\n";
      write_file(parameters_file, parameters.data(), parameters.size());
      write_file(contents, all.data(), all.size());
      synchronise(part);
      if (std::rename(part.c_str(), folder.path(name).c_str()) != 0)
        fail(folder.path(name), errno);
      synchronise(folder.path(""));

      // This one and the one before are kept, for the newest may turn out damaged. An old one that
      // cannot be removed does no harm.
      std::error_code ignored;
      for (const auto &[number, other] : list(folder.path("")))
        if (other != name && other != previous)
          fs::remove_all(folder.path(other), ignored);
    });
    previous = name;
    return name;
  }
} // namespace Touchstone
