// The factorization by 3x3 blocks against a dense one: matrices that couple nodes at random, in two
// parts, or not at all, and one that is not positive definite.

#include <supple/linear_algebra/block_factorization.h>

#include <Eigen/Dense>

#include <random>
#include <set>

#include "driver/checks.h"

using namespace Supple;

namespace
{
  std::mt19937 generator(1);


  double
  random_number()
  {
    return std::uniform_real_distribution<double>(-1., 1.)(generator);
  }


  /** Each node with some of those before it. */
  SymmetricPattern
  random_pattern(const unsigned int n_nodes, const unsigned int n_couplings)
  {
    SymmetricPattern pattern;
    pattern.n_owned = pattern.n_local = n_nodes;
    pattern.row_start.push_back(0);
    for (unsigned int row = 0; row < n_nodes; ++row)
      {
        std::set<std::uint32_t> columns;
        for (unsigned int k = 0; k < n_couplings && row > 0; ++k)
          columns.insert(generator() % row);
        pattern.column.insert(pattern.column.end(), columns.begin(), columns.end());
        pattern.row_start.push_back(pattern.column.size());
      }
    return pattern;
  }


  void
  fill(SymmetricBlockMatrix &A)
  {
    for (double &entry : A.lower)
      entry = random_number();
    for (unsigned int node = 0; node < A.pattern.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          A.diagonal[9 * node + 3 * i + j] = A.diagonal[9 * node + 3 * j + i] =
            i == j ? 3. * A.pattern.n_owned : random_number();
  }


  Eigen::MatrixXd
  dense(const SymmetricBlockMatrix &A)
  {
    const SymmetricPattern &pattern = A.pattern;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * pattern.n_owned, 3 * pattern.n_owned);
    for (unsigned int row = 0; row < pattern.n_owned; ++row)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            matrix(3 * row + i, 3 * row + j) = A.diagonal[9 * row + 3 * i + j];
            for (std::size_t k = pattern.row_start[row]; k < pattern.row_start[row + 1]; ++k)
              matrix(3 * row + i, 3 * pattern.column[k] + j) =
                matrix(3 * pattern.column[k] + j, 3 * row + i) = A.lower[9 * k + 3 * i + j];
          }
    return matrix;
  }


  void
  check(const char *what, const unsigned int n_nodes, const unsigned int n_couplings)
  {
    const SymmetricPattern pattern = random_pattern(n_nodes, n_couplings);
    SymmetricBlockMatrix A(pattern);
    BlockFactorization factorization(pattern);
    for (unsigned int repeat = 0; repeat < 2; ++repeat) // a factorization leaves nothing behind
      {
        fill(A);
        const bool definite = factorization.factorize(A);
        const Eigen::VectorXd b =
          Eigen::VectorXd::NullaryExpr(3 * n_nodes, [] { return random_number(); });
        const Eigen::VectorXd correct = dense(A).ldlt().solve(b);
        Eigen::VectorXd x(3 * n_nodes);
        factorization.solve(x.data(), b.data());
        report(what, definite ? (x - correct).norm() / correct.norm() : 1., 1e-12);
      }
    A.diagonal[9 * (n_nodes / 2) + 4] = -1.;
    std::printf("  one entry is negative: %s\n",
                factorization.factorize(A) ? "ACCEPTED" : "refused");
    fill(A);
    std::printf("  and mended: %s\n", factorization.factorize(A) ? "accepted" : "REFUSED");
  }
} // namespace


int
main()
{
  check("one node", 1, 0);
  check("no couplings", 10, 0);
  check("few couplings", 60, 1);
  check("many couplings", 60, 8);
}
