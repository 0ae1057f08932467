/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Counts what a run sends from each rank to all, or from all to one, by the interface that MPI offers
 * for that: the largest piece that a rank gives, how often the program itself, not its libraries, asks
 * for lists of all ranks, and how many sums and maxima there are. Loaded before the program, see
 * tests/checks/scaling.py. Where a piece has as many bytes as TRACE_GATHERED says, the places in the
 * program go to the error output. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <execinfo.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static long largest = 0, lists = 0, reductions = 0;

/* Whether code of the program calls; templates of deal.II that it uses belong to it. */
static int
of_program(const void *const caller)
{
  Dl_info info;
  return dladdr(caller, &info) != 0 && strstr(info.dli_fname, "touchstone") != NULL;
}

static void
count(long n, MPI_Datatype type)
{
  int size = 0;
  PMPI_Type_size(type, &size);
  if (n * size > largest)
    largest = n * size;
  const char *const trace = getenv("TRACE_GATHERED");
  if (trace != NULL && n * size >= atol(trace))
    {
      void *frames[40];
      fprintf(stderr, "gathered: %ld bytes of a rank\n", n * size);
      backtrace_symbols_fd(frames, backtrace(frames, 40), 2);
    }
}

int
MPI_Allgather(const void  *from,
              int          n,
              MPI_Datatype type,
              void        *to,
              int          number,
              MPI_Datatype type_to,
              MPI_Comm     communicator)
{
  lists += of_program(__builtin_return_address(0));
  if (from == MPI_IN_PLACE)
    count(number, type_to);
  else
    count(n, type);
  return PMPI_Allgather(from, n, type, to, number, type_to, communicator);
}

int
MPI_Allgatherv(const void  *from,
               int          n,
               MPI_Datatype type,
               void        *to,
               const int    numbers[],
               const int    begin[],
               MPI_Datatype type_to,
               MPI_Comm     communicator)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  lists += of_program(__builtin_return_address(0));
  if (from == MPI_IN_PLACE)
    count(numbers[rank], type_to);
  else
    count(n, type);
  return PMPI_Allgatherv(from, n, type, to, numbers, begin, type_to, communicator);
}

int
MPI_Gather(const void  *from,
           int          n,
           MPI_Datatype type,
           void        *to,
           int          number,
           MPI_Datatype type_to,
           int          root,
           MPI_Comm     communicator)
{
  if (from != MPI_IN_PLACE)
    count(n, type);
  return PMPI_Gather(from, n, type, to, number, type_to, root, communicator);
}

int
MPI_Gatherv(const void  *from,
            int          n,
            MPI_Datatype type,
            void        *to,
            const int    numbers[],
            const int    begin[],
            MPI_Datatype type_to,
            int          root,
            MPI_Comm     communicator)
{
  if (from != MPI_IN_PLACE)
    count(n, type);
  return PMPI_Gatherv(from, n, type, to, numbers, begin, type_to, root, communicator);
}

int
MPI_Allreduce(const void  *from,
              void        *to,
              int          n,
              MPI_Datatype type,
              MPI_Op       operation,
              MPI_Comm     communicator)
{
  count(n, type);
  ++reductions;
  return PMPI_Allreduce(from, to, n, type, operation, communicator);
}

int
MPI_Finalize(void)
{
  const char *const name = getenv("COUNT_GATHERED");
  int               rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (name != NULL)
    {
      char  path[1000];
      FILE *file;
      snprintf(path, sizeof(path), "%s.%d", name, rank);
      file = fopen(path, "w");
      if (file != NULL)
        {
          fprintf(file, "%ld %ld %ld\n", largest, lists, reductions);
          fclose(file);
        }
    }
  return PMPI_Finalize();
}
