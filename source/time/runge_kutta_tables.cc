#include <supple/base/error.h>
#include <supple/time/runge_kutta_tables.h>

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

namespace Supple
{
  using Method = TimeMethod;

  namespace
  {
    /** A method of one stage at c, without an error estimate. */
    ARKodeButcherTable
    one_stage_table(const int order, double c)
    {
      double b = 1.;
      return ARKodeButcherTable_Create(1, order, 0, &c, &c, &b, nullptr);
    }
  } // namespace


  ARKodeButcherTable
  butcher_table(const Method method)
  {
    switch (method)
      {
        case Method::backward_euler:
        case Method::implicit_backward_euler:
          return one_stage_table(1, 1.);
        case Method::implicit_midpoint:
          return one_stage_table(2, 0.5);
        case Method::sdirk2:
          return ARKodeButcherTable_LoadDIRK(ARKODE_SDIRK_2_1_2);
        case Method::trbdf2:
          return ARKodeButcherTable_LoadDIRK(ARKODE_TRBDF2_3_3_2);
        case Method::esdirk3:
          return ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK325L2SA_5_2_3);
        case Method::esdirk4:
          return ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK436L2SA_6_3_4);
        case Method::esdirk5:
          return ARKodeButcherTable_LoadDIRK(ARKODE_ESDIRK547L2SA2_7_4_5);
        case Method::imex3:
          return ARKodeButcherTable_LoadDIRK(ARKODE_ARK324L2SA_DIRK_4_2_3);
        case Method::imex4:
          return ARKodeButcherTable_LoadDIRK(ARKODE_ARK436L2SA_DIRK_6_3_4);
        case Method::imex5:
          return ARKodeButcherTable_LoadDIRK(ARKODE_ARK548L2SA_DIRK_8_4_5);
        case Method::explicit2:
          return ARKodeButcherTable_LoadERK(ARKODE_HEUN_EULER_2_1_2);
        case Method::explicit3:
          return ARKodeButcherTable_LoadERK(ARKODE_BOGACKI_SHAMPINE_4_2_3);
        case Method::explicit4:
          return ARKodeButcherTable_LoadERK(ARKODE_ZONNEVELD_5_3_4);
        case Method::explicit5:
          return ARKodeButcherTable_LoadERK(ARKODE_DORMAND_PRINCE_7_4_5);
        case Method::ida:
          break;
      }
    throw ComputationError("ARKode has no such method");
  }


  ARKodeButcherTable
  explicit_part(const Method method)
  {
    switch (method)
      {
        case Method::imex3:
          return ARKodeButcherTable_LoadERK(ARKODE_ARK324L2SA_ERK_4_2_3);
        case Method::imex4:
          return ARKodeButcherTable_LoadERK(ARKODE_ARK436L2SA_ERK_6_3_4);
        case Method::imex5:
          return ARKodeButcherTable_LoadERK(ARKODE_ARK548L2SA_ERK_8_4_5);
        default:
          throw ComputationError("the method has no explicit part");
      }
  }
} // namespace Supple
