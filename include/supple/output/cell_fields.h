#ifndef supple_cell_fields_h
#define supple_cell_fields_h

#include <supple/forces/elastic_force.h>

#include <array>
#include <utility>
#include <vector>

namespace Supple
{
  /** What files show of the state of the cells, as numbers of 32 bits by LocalCell::index. */
  struct CellFields
  {
    CellFields(const Configuration &configuration, const ElasticForce &elastic);

    /** Whether all numbers of this process are finite. */
    bool
    finite() const;

    /** The fields with their names in the files. */
    std::array<std::pair<const char *, const std::vector<float> *>, 4>
    named() const;

    std::vector<float> volume_ratio;
    std::vector<float> von_mises_stress; ///< [Pa]
    std::vector<float> rotation_angle;
    std::vector<float> pressure; ///< [Pa]
  };
} // namespace Supple

#endif
