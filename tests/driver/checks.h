#ifndef supple_tests_checks_h
#define supple_tests_checks_h

// What the compiled tests share: their outputs tell a limit and not the value, which differs from
// machine to machine.

#include <supple/linear_algebra/block_matrix.h>

#include <cmath>
#include <cstdio>
#include <vector>

/** Three components a vertex. */
using Nodal = std::vector<double>;


inline void
report(const char *what, const double value, const double limit)
{
  if (value <= limit)
    std::printf("  %s: at most %.0e\n", what, limit);
  else
    std::printf("  %s: %e is more than %.0e\n", what, value, limit);
}


inline void
report_larger(const char *what, const double value, const double limit)
{
  std::printf("  %s: %s %.0e\n", what, value > limit ? "more than" : "NOT more than", limit);
}


inline double
norm(const Nodal &v)
{
  double sum = 0.;
  for (const double x : v)
    sum += x * x;
  return std::sqrt(sum);
}


/** A pattern that couples every node with every other. */
inline Supple::SymmetricPattern
full_pattern(const unsigned int n_nodes)
{
  Supple::SymmetricPattern pattern;
  pattern.n_owned = pattern.n_local = n_nodes;
  pattern.row_start.push_back(0);
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      for (unsigned int j = 0; j < i; ++j)
        pattern.column.push_back(j);
      pattern.row_start.push_back(pattern.column.size());
    }
  return pattern;
}

#endif
