// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_folder_h
#define touchstone_base_folder_h

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

namespace Touchstone
{
  /** @brief Results cannot be written. The message names the file, the reason
   * and what can be done. */
  class OutputError : public std::runtime_error
  {
  public:
    /**
     * @param path   File or folder.
     * @param reason What the system says, e.g. "No space left on device".
     * @param remedy What to do, as a sentence.
     */
    OutputError(const std::string &path, const std::string &reason, const std::string &remedy);

    /** @brief An error with a complete message, as received from another rank. */
    explicit OutputError(const std::string &message);
  };

  /** @brief Gives the next part of a text each time that it is called, and nothing after the last:
   * for files that need not be in memory as a whole. */
  using TextInParts = std::function<std::string()>;

  /** @brief A text of one part. */
  TextInParts
  whole(std::string text);

  /**
   * @brief Write a file such that its name always stands for a complete file:
   * write @p path + ".part" and rename it.
   *
   * Not collective. @throws OutputError if any byte could not be written.
   */
  void
  write_file_atomically(const std::string &path, const TextInParts &contents);

  /** @brief The same for a text that is known as a whole. */
  void
  write_file_atomically(const std::string &path, const std::string &contents);

  /**
   * @brief The folder into which a run writes.
   *
   * All methods but path() are collective: what fails on one rank is thrown as
   * OutputError on all, so that no rank waits for one that has given up.
   */
  class OutputFolder
  {
  public:
    /** @brief Create the folder if need be, and check that it can be written to.
     * @throws OutputError */
    OutputFolder(const std::string &directory, MPI_Comm communicator);

    /** @brief Path of the file @p name in this folder. */
    std::string
    path(const std::string &name) const;

    /** @brief Write a file whose @p contents rank 0 knows. Collective.
     * @throws OutputError */
    void
    write_file_atomically(const std::string &name, const std::string &contents) const;

    /** @brief Each rank writes a file of its own. Collective.
     * @throws OutputError */
    void
    write_pieces_atomically(const std::string &name, const TextInParts &contents) const;

    /** @brief Remove the files of the folder that @p are_left of an earlier run and would be taken
     * for results of this one. Collective. @throws OutputError */
    void
    remove_earlier(
      const std::function<bool(const std::filesystem::directory_entry &)> &are_left) const;

    /** @brief Run @p action on each rank, and throw on all what OutputError one
     * of them threw. Collective. @throws OutputError */
    void
    together(const std::function<void()> &action) const;

    const std::string directory;
    const MPI_Comm    communicator;
    /** This process's rank in the communicator, and their number. */
    const unsigned int rank, n_ranks;
  };
} // namespace Touchstone

#endif
