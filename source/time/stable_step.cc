#include <supple/time/stable_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    struct StiffnessProduct
    {
      const ImplicitOperator &A;

      void
      vmult(Vector &y, const Vector &x) const
      {
        A.stiffness_vmult(y, x);
      }
    };


    struct InverseLumpedMass
    {
      const std::vector<double> &mass;

      void
      vmult(Vector &y, const Vector &x) const
      {
        for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
          y.local_element(i) = x.local_element(i) / mass[i / 3];
      }
    };


    /** Numbers between -1 and 1 that look random and do not depend on the partition. */
    void
    shuffle(Vector &vector, const Body &body)
    {
      for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
        vector.local_element(i) = std::sin(1e3 * (3. * body.serial_vertex[i / 3] + i % 3 + 1.));
    }


    /** Damping rates d [1/s] an oscillation may have. */
    struct DampingRates
    {
      double smallest, largest; ///< a + c/m
      double stiffness_factor;  ///< b

      DampingRates(const ImplicitOperator &A)
        : stiffness_factor(A.damping.stiffness_factor)
      {
        const std::vector<double> &mass = A.mass_matrix().diagonal;
        const auto [lightest, heaviest] =
          std::minmax_element(mass.begin(), mass.begin() + A.body.n_owned);
        const MPI_Comm communicator = A.body.mesh.communicator;
        smallest =
          A.damping.mass_factor + A.damping.viscous / Utilities::MPI::max(*heaviest, communicator);
        largest =
          A.damping.mass_factor + A.damping.viscous / Utilities::MPI::min(*lightest, communicator);
      }
    };


    /** The roots of lambda^2 + d lambda + omega^2 = 0. */
    std::array<std::complex<double>, 2>
    roots(const double d, const double omega)
    {
      const std::complex<double> root =
        std::sqrt(std::complex<double>(0.25 * d * d - omega * omega));
      return {{-0.5 * d + root, -0.5 * d - root}};
    }


    std::vector<std::complex<double>>
    rates_of_motion(const double largest_frequency, const DampingRates &damping)
    {
      constexpr unsigned int n_samples = 64;
      std::vector<std::complex<double>> rates;
      for (unsigned int k = 1; k <= n_samples; ++k)
        {
          const double omega = largest_frequency * k / n_samples;
          for (const double d : {damping.smallest, damping.largest})
            for (const auto &lambda : roots(d + damping.stiffness_factor * omega * omega, omega))
              rates.push_back(lambda);
        }
      return rates;
    }


    bool
    is_stable(const ARKodeButcherTable &table,
              const std::vector<std::complex<double>> &rates,
              const double step,
              const double duration)
    {
      const double growth = std::pow(2., std::min(step / duration, 0.01));
      return std::all_of(rates.begin(), rates.end(), [&](const std::complex<double> &lambda) {
        return std::abs(stability_function(table, step * lambda)) <= growth;
      });
    }


    /** The end of the first interval of stable steps. */
    double
    largest_stable_step(const ARKodeButcherTable &table,
                        const std::vector<std::complex<double>> &rates,
                        const double duration)
    {
      double fastest = 0.;
      for (const auto &lambda : rates)
        fastest = std::max(fastest, std::abs(lambda));
      if (fastest == 0.)
        return std::numeric_limits<double>::infinity();
      const double part = 0.02 / fastest;

      double unstable = part;
      while (is_stable(table, rates, unstable, duration))
        unstable += part;
      double stable = unstable - part;
      while (unstable - stable > 1e-6 * unstable)
        {
          const double middle = 0.5 * (stable + unstable);
          (is_stable(table, rates, middle, duration) ? stable : unstable) = middle;
        }
      return stable;
    }
  } // namespace


  std::string
  StableStep::description() const
  {
    if (std::isinf(step))
      return "any length (nothing of the body is free to swing)";
    std::ostringstream text;
    text << step << " s (the body's fastest oscillation at rest has " << frequency << " rad/s)";
    return text.str();
  }


  std::complex<double>
  stability_function(const ARKodeButcherTable &table, const std::complex<double> z)
  {
    std::vector<std::complex<double>> stages(table->stages);
    std::complex<double> sum = 1.;
    for (int i = 0; i < table->stages; ++i)
      {
        stages[i] = 1.;
        for (int j = 0; j < i; ++j)
          stages[i] += z * table->A[i][j] * stages[j];
        sum += z * table->b[i] * stages[i];
      }
    return sum;
  }


  double
  largest_frequency(const ImplicitOperator &A)
  {
    const StiffnessProduct K{A};
    const InverseLumpedMass P{A.mass_matrix().diagonal};
    Vector x, b;
    A.body.initialize(x);
    A.body.initialize(b);
    shuffle(x, A.body);
    A.constraints.set_zero(x);
    K.vmult(b, x); // solvable even where the body is free
    x = 0.;

    double largest = 0.;
    SolverControl control(100, 1e-10 * b.l2_norm());
    SolverCG<Vector> cg(control);
    cg.connect_eigenvalues_slot(
      [&](const std::vector<double> &values) { largest = values.empty() ? 0. : values.back(); });
    try
      {
        cg.solve(K, x, b, P);
      }
    catch (const SolverControl::NoConvergence &)
      {
        // It was not the solution that was asked for.
      }
    return std::sqrt(largest);
  }


  StableStep
  find_stable_step(const ImplicitOperator &A,
                   const ARKodeButcherTable &table,
                   const double duration)
  {
    StableStep result;
    result.frequency = largest_frequency(A);
    DampingRates damping(A);
    result.step = largest_stable_step(table, rates_of_motion(result.frequency, damping), duration);
    damping.smallest = damping.largest = damping.stiffness_factor = 0.;
    result.limit                                                  = result.frequency *
                   largest_stable_step(table, rates_of_motion(result.frequency, damping), duration);
    return result;
  }
} // namespace Supple
