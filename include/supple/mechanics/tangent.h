#ifndef supple_tangent_h
#define supple_tangent_h

namespace Supple
{
  /**
   * Which derivative of the force an implicit step takes.
   *
   * - automatic: consistent, and definite where that fails.
   * - frozen: as if rotations stayed what they are: positive definite, but no derivative of the
   * force.
   * - consistent: the derivative of the force, which is symmetric but may be indefinite where the
   * body is compressed.
   * - definite: the same, projected cell by cell to the nearest positive semidefinite one.
   */
  enum class Tangent
  {
    automatic,
    frozen,
    consistent,
    definite
  };


  /** Of the operator A = mass M - velocity df/dv - displacement df/du with forces f. */
  struct TangentFactors
  {
    double mass         = 0.;
    double velocity     = 0.;
    double displacement = 0.;
  };
} // namespace Supple

#endif
