#ifndef supple_measurements_h
#define supple_measurements_h

#include <string>
#include <vector>

namespace Supple
{
  /** How deep a surface lies at some distances from a needle, in one indentation. */
  struct MeasuredSet
  {
    unsigned int number;
    std::vector<double> distances;   ///< from the needle, along the surface at rest [m], ascending
    std::vector<double> depths;      ///< [m]
    std::vector<std::string> places; ///< file:line of each
  };


  /**
   * Reads a CSV file whose first line is "set,distance,depth"; further columns count for nothing.
   * @param unit   of its lengths [m]
   * @param wanted numbers of the sets, or none for all
   * @param origin who names the file, to begin a message with
   * @return the sets in the order of their numbers
   * @throws InputError with file and line if something is missing, no number, negative or not in
   * the order of the distance, or if a set has less than three points
   */
  std::vector<MeasuredSet>
  read_measurements(const std::string &file,
                    double unit,
                    const std::vector<unsigned int> &wanted,
                    const std::string &origin);
} // namespace Supple

#endif
