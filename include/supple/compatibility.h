#ifndef supple_compatibility_h
#define supple_compatibility_h

/** @file What differs between deal.II 9.4 with SUNDIALS 6 (Debian 12) and deal.II 9.6 with SUNDIALS
 * 7 (Debian 13). */

#include <deal.II/base/config.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <arkode/arkode_arkstep.h>

#include <cstdlib>
#include <string>

namespace Supple
{
  namespace Compatibility
  {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
    using Real = sunrealtype;
#else
    using Real = realtype;
#endif


    /** Where ARKode's errors go: into @p message, which must outlive the solver, and not onto the
     * screen. */
    inline void
    collect_arkode_errors(void *arkode_memory, std::string &message)
    {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      (void)arkode_memory;
      (void)message;
#else
      ARKStepSetErrHandlerFn(
        arkode_memory,
        [](int code, const char *, const char *function, char *text, void *target) {
          if (code < 0)
            *static_cast<std::string *>(target) = std::string(function) + ": " + text;
        },
        &message);
#endif
    }


    template <int dim, int spacedim>
    dealii::IndexSet
    locally_relevant_dofs(const dealii::DoFHandler<dim, spacedim> &dof_handler)
    {
#if DEAL_II_VERSION_GTE(9, 6, 0)
      return dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
#else
      dealii::IndexSet relevant;
      dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
      return relevant;
#endif
    }
  } // namespace Compatibility
} // namespace Supple

#endif
