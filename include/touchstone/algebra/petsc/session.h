// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_petsc_session_h
#define touchstone_algebra_petsc_session_h

#include <mpi.h>
#include <petscksp.h>
#include <stdexcept>
#include <string>
#include <vector>

// Errors and options of PETSc, whose functions report and read them for the whole process.
namespace Touchstone
{
  namespace Petsc
  {
    /** @brief An error of PETSc, with the first line of its message. */
    class PetscError : public std::runtime_error
    {
      using std::runtime_error::runtime_error;
    };



    /**
     * @brief Options as on PETSc's command line, in a database of their own: the global one belongs
     * to the process, and two solvers with different options must not mix theirs.
     */
    class OptionsDatabase
    {
    public:
      /** @throws PetscError if @p text is none. */
      explicit OptionsDatabase(const std::string &text);

      ~OptionsDatabase()
      {
        PetscOptionsDestroy(&data);
      }

      OptionsDatabase(const OptionsDatabase &) = delete;
      OptionsDatabase &
      operator=(const OptionsDatabase &) = delete;

      /** @brief Names of those that nothing has asked for. */
      std::vector<std::string>
      unused() const;

      PetscOptions data = nullptr;
    };



    /**
     * @brief A scope in which PETSc is called. It makes PETSc read the options of one database
     * only, and keeps the first line of an error instead of printing it, so that check() can throw
     * it. C functions on the way must not be left by an exception, hence the two stages.
     */
    class Session
    {
    public:
      /** @param options Null: those of the process. */
      explicit Session(const OptionsDatabase *options)
        : pushed(options != nullptr)
      {
        PetscPushErrorHandler(&keep, this);
        if (pushed)
          PetscOptionsPush(options->data);
      }

      ~Session()
      {
        if (pushed)
          PetscOptionsPop();
        PetscPopErrorHandler();
      }

      Session(const Session &) = delete;
      Session &
      operator=(const Session &) = delete;

      /** @throws PetscError if @p error is one. */
      void
      check(const PetscErrorCode error)
      {
        if (error != 0)
          throw PetscError(message.empty() ? "error " + std::to_string(static_cast<int>(error))
                                           : message);
      }

    private:
      const bool  pushed;
      std::string message;

      static PetscErrorCode
      keep(MPI_Comm,
           int,
           const char *,
           const char *,
           PetscErrorCode error,
           PetscErrorType type,
           const char    *text,
           void          *self)
      {
        // Each function on the way back reports the error again; the first report has the reason.
        if (type == PETSC_ERROR_INITIAL && text)
          {
            std::string first                     = text;
            first                                 = first.substr(0, first.find('\n'));
            static_cast<Session *>(self)->message = first;
          }
        return error;
      }
    };
  } // namespace Petsc
} // namespace Touchstone

#endif
