// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_archive_checkpoints_h
#define touchstone_archive_checkpoints_h

#include <touchstone/base/folder.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <string>
#include <vector>

/**
 * @file
 * Checkpoints on disk.
 *
 * A checkpoint is a folder `checkpoint_000007` in the output folder, the number going up by
 * one each time. In it are
 *
 *     piece_0.bin, piece_1.bin, ...  one for each rank, see archive/archive.h
 *     parameters.prm                 all parameters of the run
 *     contents                       text, in this order:
 *       touchstone checkpoint, format 1
 *       step 12
 *       time 0.3
 *       pieces 2
 *       piece_0.bin 123456 0a1b2c3d     for each file its size and CRC-32
 *       ...
 *       complete 4e5f6071               CRC-32 of all that stands above
 *
 * The folder is written under the name `checkpoint_000007.part`, each file and then the folder
 * are forced to the disk, and only then is it renamed: what has the name is complete,
 * whenever the program dies.
 */

namespace Touchstone
{
  /** @brief A checkpoint that has been found to be complete. */
  struct Checkpoint
  {
    /** Name of its folder, without the path. */
    std::string  name;
    unsigned int number   = 0;
    unsigned int step     = 0;
    double       time     = 0.;
    unsigned int n_pieces = 0;
    std::string  folder;

    /** @throws std::runtime_error if it cannot be read any more. */
    std::vector<char>
    piece(unsigned int number) const;

    /** @brief The text of its parameters. */
    std::string
    parameters() const;
  };

  /** @brief The newest checkpoint of an output folder that is complete. */
  struct FoundCheckpoint
  {
    /** Null if there is none. */
    std::shared_ptr<const Checkpoint> checkpoint;
    /** Messages about newer ones that are incomplete or damaged. */
    std::vector<std::string> skipped;
  };

  /** @brief Look for the newest complete checkpoint, checksums included. Collective. */
  FoundCheckpoint
  find_checkpoint(const std::string &directory, MPI_Comm communicator);

  /** @brief Writes checkpoints, and keeps the last two. */
  class Checkpoints
  {
  public:
    /** @param folder  Must outlive this object.
     * @param present The one that the run resumes from, or null: then older ones are
     *                another run's, and are removed when the first has been written. */
    Checkpoints(const OutputFolder &folder, const std::shared_ptr<const Checkpoint> &present);

    /** @brief Write one. Collective.
     * @param piece      Of this rank.
     * @param parameters Text, of rank 0.
     * @return its name. @throws OutputError on all ranks; older ones are there still. */
    std::string
    write(const std::vector<char> &piece,
          unsigned int             step,
          double                   time,
          const std::string       &parameters);

  private:
    const OutputFolder &folder;
    /** Name of the last one that this run has written or resumed from. */
    std::string  previous;
    unsigned int last_number = 0;
  };
} // namespace Touchstone

#endif
