#ifndef supple_vector_h
#define supple_vector_h

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  /** Three numbers per node; owned nodes first, then ghosts, which are valid only when asked for.
   */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** While it lives, the ghost values of a vector are valid. On a single process it does nothing.
   */
  class GhostValues
  {
  public:
    explicit GhostValues(const Vector &vector)
      : vector(vector)
    {
      if (vector.get_partitioner()->n_mpi_processes() > 1)
        vector.update_ghost_values();
    }

    ~GhostValues()
    {
      if (vector.get_partitioner()->n_mpi_processes() > 1)
        vector.zero_out_ghost_values();
    }

    GhostValues(const GhostValues &) = delete;
    GhostValues &
    operator=(const GhostValues &) = delete;

    const double *
    data() const
    {
      return vector.begin();
    }

  private:
    const Vector &vector;
  };


  /** Calls @p add(double *) on a vector set to zero, whose ghost part may be written but means
   * nothing. */
  template <class Add>
  void
  sum_into(Vector &vector, const Add &add)
  {
    vector = 0.;
    add(vector.begin());
    if (vector.get_partitioner()->n_mpi_processes() > 1)
      vector.zero_out_ghost_values();
  }


  /** Whether every entry on every process is a finite number. (deal.II's norms abort on others in
   * Debug.) */
  inline bool
  all_finite(const Vector &vector)
  {
    const double *const begin = vector.begin();
    const bool here           = std::all_of(begin,
                                  begin + vector.locally_owned_size(),
                                  [](const double value) { return std::isfinite(value); });
    return dealii::Utilities::MPI::min(here ? 1 : 0,
                                       vector.get_partitioner()->get_mpi_communicator()) == 1;
  }


  /** This process's part of the product of two vectors. */
  inline double
  local_product(const Vector &a, const Vector &b)
  {
    double sum = 0.;
    for (unsigned int dof = 0; dof < a.locally_owned_size(); ++dof)
      sum += a.local_element(dof) * b.local_element(dof);
    return sum;
  }


  /** The largest length, over all vertices, of the difference of two vectors. */
  inline double
  largest_vertex_distance(const Vector &a, const Vector &b)
  {
    double square = 0.;
    for (unsigned int first = 0; first + 2 < a.locally_owned_size(); first += 3)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double difference = a.local_element(first + i) - b.local_element(first + i);
            sum += difference * difference;
          }
        square = std::max(square, sum);
      }
    return std::sqrt(
      dealii::Utilities::MPI::max(square, a.get_partitioner()->get_mpi_communicator()));
  }
} // namespace Supple

#endif
