#include <supple/base/error.h>
#include <supple/input/entries.h>
#include <supple/scene/parameters.h>

#include <deal.II/base/utilities.h>

#include <regex>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  void
  MaterialParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Material");
    add_choice(prm,
               "Elastic constants",
               constants,
               {{"Young and Poisson", Constants::young_poisson}, {"Lame", Constants::lame}},
               "Which pair of constants is used: Young modulus and Poisson ratio, or Lame lambda "
               "and Lame mu.");
    add(prm, "Young modulus", young, "Pa", Range::between(0, infinity), "Young's modulus E.");
    add(prm, "Poisson ratio", poisson, "none", Range::between(-1, 0.5), "Poisson's ratio nu.");
    add(prm,
        "Lame lambda",
        lambda,
        "Pa",
        Range::finite(),
        "Lame's first parameter; 3 lambda + 2 mu must be positive.");
    add(prm,
        "Lame mu",
        mu,
        "Pa",
        Range::between(0, infinity),
        "Lame's second parameter, the shear modulus.");
    add(prm,
        "Density",
        density,
        "kg/m^3",
        Range::between(0, infinity),
        "Mass per volume of the body at rest.");
    prm.add_parameter("By id",
                      by_id,
                      "Cells with these material ids are of another material. Unit: none; Pa, "
                      "none, kg/m^3. Range: id: Young "
                      "modulus, Poisson ratio, density, set apart by semicolons.",
                      dealii::Patterns::Anything());
    add_choice(prm,
               "Mass",
               lumped,
               {{"consistent", false}, {"lumped", true}},
               "Consistent mass matrix, or all mass of a cell shared evenly by its vertices.");
    add(prm,
        "Mass per vertex",
        vertex_mass,
        "kg",
        Range::at_least(0),
        "If positive, every vertex has this mass, and densities count for nothing.");
    add_choice(prm,
               "Volumetric locking cure",
               cure,
               {{"none", LockingCure::none}, {"patches", LockingCure::patches}},
               "Linear cells are too stiff where the material is almost incompressible. patches: "
               "about eight tetrahedra, or four triangles, resist together to a change of their "
               "volume, which cures it (doc/locking.md).");
    add_choice(prm,
               "Volume change",
               volume_measure,
               {{"trace", VolumeMeasure::trace}, {"determinant", VolumeMeasure::determinant}},
               "What patches resist to. determinant: the true change of volume. trace: its "
               "approximation for small strains, which loses volume at large ones but pushes the "
               "flattest cells back; without rotations (linear elasticity) it is always this one.");
    prm.leave_subsection();
  }


  namespace
  {
    IsotropicMaterial
    from_young_poisson(const double young, const double poisson, const double density)
    {
      return {young * poisson / ((1. + poisson) * (1. - 2. * poisson)),
              young / (2. * (1. + poisson)),
              density};
    }
  } // namespace


  IsotropicMaterial
  MaterialParameters::preset() const
  {
    if (constants == Constants::lame)
      return {lambda, mu, density};
    return from_young_poisson(young, poisson, density);
  }


  std::map<unsigned int, IsotropicMaterial>
  MaterialParameters::exceptions(const std::string &origin) const
  {
    std::map<unsigned int, IsotropicMaterial> materials;
    for (const std::string &item : dealii::Utilities::split_string_list(by_id, ';'))
      {
        if (item.empty())
          continue;
        std::smatch found;
        std::vector<std::string> numbers;
        if (std::regex_match(item, found, std::regex("(\\d{1,6})\\s*:(.*)")))
          numbers = dealii::Utilities::split_string_list(found[2], ',');
        if (numbers.size() != 3 || !Range::between(0, infinity).match(numbers[0]) ||
            !Range::between(-1, 0.5).match(numbers[1]) ||
            !Range::between(0, infinity).match(numbers[2]))
          throw InputError(
            origin + ": '" + item +
            "' is not of the form id: Young modulus, Poisson ratio, density, with a positive "
            "modulus and density and a ratio greater than -1 and less than 0.5.");
        materials[std::stoul(found[1])] =
          from_young_poisson(std::stod(numbers[0]), std::stod(numbers[1]), std::stod(numbers[2]));
      }
    return materials;
  }
} // namespace Supple
