#ifndef supple_gather_h
#define supple_gather_h

#include <supple/base/error.h>

#include <cstddef>
#include <limits>
#include <mpi.h>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

namespace Supple
{
  /**
   * The lists of all processes one after the other, on the first process; elsewhere nothing.
   * Collective. The numbers travel as they are: deal.II's gather() packs them first, which takes
   * longer than to make them.
   * @throws ComputationError on all processes if there are more than MPI can count, 2^31
   */
  template <class Value>
  std::vector<Value>
  gathered_on_first(const std::vector<Value> &own, const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable<Value>::value, "numbers travel as they are");
    int n_ranks, rank;
    MPI_Comm_size(communicator, &n_ranks);
    MPI_Comm_rank(communicator, &rank);
    if (n_ranks == 1)
      return own;

    const unsigned long n_own = own.size();
    std::vector<unsigned long> n_of(n_ranks);
    MPI_Allgather(&n_own, 1, MPI_UNSIGNED_LONG, n_of.data(), 1, MPI_UNSIGNED_LONG, communicator);
    const unsigned long n_all = std::accumulate(n_of.begin(), n_of.end(), 0ul);
    if (n_all > static_cast<unsigned long>(std::numeric_limits<int>::max()))
      throw ComputationError("the body is too large to be gathered on one process: " +
                             std::to_string(n_all) + " numbers");

    std::vector<int> counts(n_of.begin(), n_of.end()), starts(n_ranks, 0);
    std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
    std::vector<Value> all(rank == 0 ? n_all : 0);
    MPI_Datatype type;
    MPI_Type_contiguous(sizeof(Value), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    MPI_Gatherv(own.data(),
                int(n_own),
                type,
                all.data(),
                counts.data(),
                starts.data(),
                type,
                0,
                communicator);
    MPI_Type_free(&type);
    return all;
  }
} // namespace Supple

#endif
