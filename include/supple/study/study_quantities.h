#ifndef supple_study_quantities_h
#define supple_study_quantities_h

#include <supple/base/expression.h>
#include <supple/study/study_plan.h>
#include <supple/study/study_record.h>

#include <set>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * What a study measures of its runs: errors over time against a reference or exact values, and
   * numbers that stand in its table, with their errors.
   */
  class StudyQuantities
  {
  public:
    /** @throws InputError if something is asked for that the scene hasn't */
    StudyQuantities(const StudyParameters &study, const StudyPlan &plan);

    /** The columns of history.csv and probes.csv that are needed. */
    std::set<std::string>
    needed() const;

    std::vector<std::string>
    error_names() const;

    /** What the errors are relative to, in words. */
    std::string
    error_meaning() const;

    /** Relative errors of a run, one for each name above; not-a-number where there is none.
     * @param reference may be missing where there are exact values */
    std::vector<double>
    errors(const StudyRecord &run, const StudyRecord *reference) const;

    std::vector<std::string>
    value_names() const;

    /** The numbers for the table, one for each name above; not-a-number where there is none. */
    std::vector<double>
    values(const StudyRecord &run) const;

    /**
     * Of a run with a condition, "right", "wrong", or "warned": wrong, but with a warning that the
     * condition asks for ("... or warning TEXT", "... or LESS with warning TEXT" where LESS holds).
     * What speaks of a number that is none does not hold.
     * @param above values of the row above, if there is one; the condition knows them as above_NAME
     */
    std::string
    verdict(const PlannedRun &run,
            const std::vector<double> &values,
            const std::vector<double> &above,
            const std::vector<std::string> &warnings) const;

  private:
    /** A number of a run: "largest tip.uz". */
    struct Value
    {
      std::string name;
      std::string reduction; ///< last, first, ..., at, summary
      std::string column;    ///< or where in summary.json
      double time = 0.;      ///< of at [s]
    };

    struct ExactValue
    {
      std::string name; ///< of a column or of a value
      Expression expression;
    };

    void
    read_quantities(const StudyParameters &study, const StudyPlan &plan);

    void
    read_values(const StudyParameters &study);

    void
    read_exact_values(const StudyParameters &study);

    void
    check_conditions(const StudyPlan &plan) const;

    bool
    holds(const std::string &condition,
          const std::vector<double> &values,
          const std::vector<double> &above) const;

    /** @throws InputError where there is no such column */
    void
    check_column(const std::string &name, const std::string &place) const;

    double
    error_over_time(const std::string &quantity,
                    const StudyRecord &run,
                    const StudyRecord &reference) const;

    double
    error_of_probes(const StudyRecord &run, const StudyRecord &reference) const;

    const StudyPlan::Kind kind;
    const std::set<std::string> available; ///< columns
    const std::string probes_changed;      ///< by the command line: the beginning of a message
    std::vector<std::string> points;       ///< names of point probes
    std::vector<std::string> quantities;
    std::vector<Value> all_values;
    std::vector<ExactValue> exact;
    const std::string condition_place;
  };
} // namespace Supple

#endif
