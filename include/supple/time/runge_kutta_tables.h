#ifndef supple_runge_kutta_tables_h
#define supple_runge_kutta_tables_h

#include <supple/time/time_parameters.h>

#include <arkode/arkode_butcher.h>

namespace Supple
{
  /** The Butcher table of a Runge-Kutta method, to be freed by ARKodeButcherTable_Free(). Of a
   * semi-implicit one, that of its implicit part. @throws ComputationError for other methods */
  ARKodeButcherTable
  butcher_table(TimeMethod method);

  /** Of a semi-implicit method, the table of its explicit part (Kennedy & Carpenter 2003, 2019),
   * with the weights and abscissae of the other. */
  ARKodeButcherTable
  explicit_part(TimeMethod method);
} // namespace Supple

#endif
