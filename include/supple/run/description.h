#ifndef supple_description_h
#define supple_description_h

#include <supple/observe/diagnostics.h>
#include <supple/observe/probes.h>
#include <supple/run/course.h>
#include <supple/run/problem.h>
#include <supple/run/skipped_pulses.h>
#include <supple/run/summary.h>
#include <supple/time/time_integrator.h>

#include <string>
#include <vector>

namespace Supple
{
  class Contact;


  /** Describes a run in words. */
  class Description
  {
  public:
    Description(const Problem &problem,
                const TimeIntegrator &integrator,
                const Probes &probes,
                const Diagnostics &diagnostics,
                const Course &course,
                const SkippedPulses &pulses);

    /** Prints what is run, as a table. @param in_detail with what was found in the mesh */
    void
    print(bool in_detail) const;

    /** What the user should know, in sentences. */
    std::vector<std::string>
    warnings() const;

  private:
    void
    print_mesh_details() const;

    /** The method in time, with its steps. */
    std::string
    time_in_words() const;

    /** Which errors are estimated. */
    std::string
    errors_in_words() const;

    /** The geometry of a plane body, to begin the description of its model with. */
    std::string
    section_in_words() const;

    /** The warnings that come up in the course of a run. */
    std::vector<std::string>
    warnings_of_motion() const;

    std::vector<std::string>
    warnings_of_contact() const;

    /** Whether what sticks and what slips may depend on round-off; empty if not. */
    std::string
    trouble_of_friction(const Contact &contact) const;

    std::vector<std::string>
    warnings_of_solver() const;

    /** A warning where cells are less than half or more than twice as large as at rest, or nothing:
     * a strain is not small there, however it is measured. */
    std::string
    strains_too_large() const;

    /** A warning where the time stepping itself drives the motion, or nothing. */
    std::string
    energy_from_nowhere() const;

    const Problem &problem;
    const TimeIntegrator &integrator;
    const Probes &probes;
    const Diagnostics &diagnostics;
    const Course &course;
    const SkippedPulses &pulses;
  };


  /**
   * Prints how a run has ended.
   * @param folder   of the results; may be empty
   * @param report   its file; empty if there is none
   * @param told     warnings that were printed before
   */
  void
  print_result(const Summary &summary,
               const std::string &folder,
               const std::string &report,
               const std::vector<std::string> &told);
} // namespace Supple

#endif
