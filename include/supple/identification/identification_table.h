#ifndef supple_identification_table_h
#define supple_identification_table_h

#include <supple/identification/identification_fit.h>
#include <supple/identification/identification_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** What was found for a pair. */
  struct PairErrors
  {
    LayerPair pair;
    std::vector<double> needle_depths; ///< of each set [m]
    std::vector<double> errors;        ///< of each set [m]

    double
    total(IdentificationParameters::Total how) const;
  };


  /** A pair of least error, and how far others of nearly the same error reach. */
  struct FittedPair
  {
    std::string of;  ///< "set 1", or "root of squares"
    FitResult found; ///< values: errors [m]
  };


  /** A point of a measured surface, and what was computed for it [m]. */
  struct ComparedPoint
  {
    double distance, measured;
    std::vector<double> computed; ///< left, right, or both
  };


  /** The results of an identification, and what follows from them. Lengths become those of its unit
   * when they are written. */
  struct IdentificationTable
  {
    std::string name; ///< of the identification
    std::string unit;
    double unit_length;             ///< [m]
    std::vector<std::string> facts; ///< sentences to stand before the tables
    std::vector<unsigned int> set_numbers;
    std::vector<std::string> side_names;
    std::vector<double> thicknesses; ///< of the grid [m]
    std::vector<double> ratios;      ///< of the grid
    std::string note;                ///< what is missing, a sentence; empty if nothing is
    double tolerance;                ///< of fits
    std::vector<PairErrors> pairs;   ///< in the order of the grid, so far as it is done
    std::vector<FittedPair> fits;
    std::vector<std::vector<ComparedPoint>> best_profiles; ///< by set

    /** The pair of least error in a set. */
    const PairErrors &
    best_of_set(std::size_t set) const;

    const PairErrors &
    best_of_total(IdentificationParameters::Total how) const;

    /** Whether a pair lies on an edge of the grid, beyond which a better one may be. */
    bool
    on_edge(const LayerPair &pair) const;

    /** "0.75 mm and 10" */
    std::string
    words(const LayerPair &pair) const;

    /** What is to be said of a pair on an edge, or nothing. */
    std::string
    edge_words(const LayerPair &pair) const;

    /** Which bounds of the search cut a range off at this pair, its end; or nothing. */
    std::string
    bound_words(const LayerPair &pair) const;

    /** How far the pairs reach whose error is within the tolerance of the best. */
    std::string
    range_words(const FitResult &found) const;

    /** The best pair of each set and of each total, a sentence each; and the fits. */
    std::vector<std::string>
    sentences() const;

    std::string
    csv() const;

    std::string
    markdown() const;

    /** Best pair of each fit, and the ends of its range. */
    std::string
    fits_csv() const;

    /** Measured and computed surfaces. */
    std::string
    profiles_csv() const;

    /** A length in the unit, with five digits. */
    std::string
    length(double metres) const;
  };


  /**
   * Writes scripts for gnuplot with the data in them, and has them draw SVG and PNG: a heat map of
   * the errors for each set and one for their root of squares, and the best profiles.
   * @return what went wrong, in a sentence; empty if nothing did
   */
  std::string
  plot_identification(const IdentificationTable &table, const std::string &folder);


  /** Writes report.html: heat maps of the errors, the best profiles, the table. @throws WriteError
   */
  void
  write_report(const std::string &folder, const IdentificationTable &table);
} // namespace Supple

#endif
