/* Counts what a program sends by MPI between its processes, and says so at the end: to be put before
 * the MPI library by LD_PRELOAD. Reductions count with what each process gives to them. */

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

static double sent_bytes, reduced_bytes;
static long n_sent, n_reduced;

static double
size_of(int count, MPI_Datatype type)
{
  int size;
  PMPI_Type_size(type, &size);
  return (double)count * size;
}

int
MPI_Isend(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  sent_bytes += size_of(count, type);
  ++n_sent;
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int
MPI_Allreduce(const void *from, void *to, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  reduced_bytes += size_of(count, type);
  ++n_reduced;
  return PMPI_Allreduce(from, to, count, type, op, comm);
}

int
MPI_Finalize(void)
{
  const char *path = getenv("SUPPLE_MESSAGES");
  double mine[4] = {n_sent, sent_bytes, n_reduced, reduced_bytes}, largest[4];
  int rank;
  PMPI_Reduce(mine, largest, 4, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0 && path)
    {
      FILE *file = fopen(path, "w");
      if (file)
        {
          fprintf(file, "%.0f %.0f %.0f %.0f\n", largest[0], largest[1], largest[2], largest[3]);
          fclose(file);
        }
    }
  return PMPI_Finalize();
}
