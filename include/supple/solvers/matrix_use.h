#ifndef supple_matrix_use_h
#define supple_matrix_use_h

namespace Supple
{
  /** How many linear systems a matrix that changes serves: what to choose a solver by. */
  enum class MatrixUse
  {
    one_system,
    some_systems, ///< Newton's method, and static scenes
    many_systems  ///< all stages of many steps
  };
} // namespace Supple

#endif
