#ifndef supple_compatibility_h
#define supple_compatibility_h

/** @file
 * deal.II 9.4, SUNDIALS 6 (Debian 12) beside deal.II 9.6, SUNDIALS 7 (13): what differs. */

#include <deal.II/base/config.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <arkode/arkode_arkstep.h>
#include <idas/idas.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>

#include <cstdlib>
#include <string>

namespace Supple
{
  namespace Compatibility
  {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
    using Boolean                      = sunbooleantype;
    constexpr int linear_solver_failed = SUN_ERR_EXT_FAIL;
#else
    using Boolean                                = booleantype;
    constexpr int linear_solver_failed           = SUNLS_PACKAGE_FAIL_UNREC;
#endif


    /** Whether ARKode tells of the first stage of a step where that is its start. */
#if DEAL_II_SUNDIALS_VERSION_GTE(6, 7, 0)
    constexpr bool tells_of_explicit_first_stage = false;
#else
    constexpr bool tells_of_explicit_first_stage = true;
#endif


    inline SUNContext
    create_sundials_context(MPI_Comm &communicator)
    {
      SUNContext context = nullptr;
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      SUNContext_Create(communicator, &context);
#else
      SUNContext_Create(&communicator, &context);
#endif
      return context;
    }


    /** Where the errors of all that has this context go: into @p message, which must outlive it. */
    inline void
    collect_errors(const SUNContext context, std::string &message)
    {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      SUNContext_ClearErrHandlers(context);
      SUNContext_PushErrHandler(
        context,
        [](int,
           const char *function,
           const char *,
           const char *text,
           SUNErrCode,
           void *target,
           SUNContext) {
          *static_cast<std::string *>(target) = std::string(function) + ": " + (text ? text : "");
        },
        &message);
#else
      (void)context;
      (void)message;
#endif
    }

    /** The same for ARKode, where it has a handler of its own. */
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


    /** The same for IDA. */
    inline void
    collect_ida_errors(void *ida_memory, std::string &message)
    {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      (void)ida_memory;
      (void)message;
#else
      IDASetErrHandlerFn(
        ida_memory,
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
