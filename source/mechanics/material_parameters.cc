#include <supple/mechanics/material_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>
#include <supple/mechanics/laws.h>

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
    add(
      prm,
      "Law",
      law,
      "none",
      Range::one_of(names_of_laws()),
      "The law by which stress follows from deformation (doc/materials.md). corotational: Hooke's "
      "law in a frame that turns with each cell. The others are derivatives of an energy and have "
      "no rotations that a step could hold: of Time/Method they take all but backward euler and "
      "imex3 to imex5. The constants below are those of small strains for all of them.");
    add(prm,
        "Mooney ratio",
        mooney_ratio,
        "none",
        Range::at_least(0),
        "mooney-rivlin: c2 / c1, with 2 (c1 + c2) the shear modulus. 0 is neo-hookean.");
    declare_constants(prm);
    add(prm,
        "Density",
        density,
        "kg/m^3",
        Range::between(0, infinity),
        "Mass per volume of the body at rest.");
    prm.add_parameter("By id",
                      by_id,
                      "Cells with these material ids, or in groups of the mesh file with these "
                      "names, are of another material. Unit: none; Pa, "
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
    add_choice(
      prm,
      "Volumetric locking cure",
      cure,
      {{"none", LockingCure::none}, {"patches", LockingCure::patches}},
      "Cells are too stiff where the material is almost incompressible. patches: "
      "about eight tetrahedra, twelve quadratic ones, or four triangles, resist together to "
      "a change of their volume, which cures it (doc/locking.md).");
    add_choice(prm,
               "Volume change",
               volume_measure,
               {{"trace", VolumeMeasure::trace}, {"determinant", VolumeMeasure::determinant}},
               "What patches resist to. determinant: the true change of volume. trace: its "
               "approximation for small strains, which loses volume at large ones but pushes the "
               "flattest cells back; without rotations (linear elasticity) it is always this one.");
    prm.leave_subsection();
  }


  void
  MaterialParameters::declare_constants(ParameterHandler &prm)
  {
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
  }


  void
  MaterialParameters::check(const ParameterFile &scene) const
  {
    if (3. * preset().lambda + 2. * preset().mu <= 0.)
      throw InputError(scene.origin("Material/Lame lambda") +
                       ": 3 lambda + 2 mu must be positive, or the body gives way to pressure.");
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
  MaterialParameters::exceptions(const std::string &origin,
                                 const std::map<std::string, unsigned int> &names) const
  {
    std::map<unsigned int, IsotropicMaterial> materials;
    for (const std::string &item : dealii::Utilities::split_string_list(by_id, ';'))
      {
        if (item.empty())
          continue;
        std::smatch found;
        std::vector<std::string> numbers;
        unsigned int id = 0;
        if (std::regex_match(item, found, std::regex("([^:]*[^:\\s])\\s*:(.*)")))
          {
            const auto name  = names.find(found[1]);
            const bool is_id = Range::whole_number(0).match(found[1]);
            if (is_id || name != names.end())
              numbers = dealii::Utilities::split_string_list(found[2], ',');
            if (!numbers.empty())
              id = is_id ? std::stoul(found[1]) : name->second;
          }
        if (numbers.size() != 3 || !Range::between(0, infinity).match(numbers[0]) ||
            !Range::between(-1, 0.5).match(numbers[1]) ||
            !Range::between(0, infinity).match(numbers[2]))
          throw InputError(
            origin + ": '" + item +
            "' is not of the form id: Young modulus, Poisson ratio, density, with a positive "
            "modulus and density and a ratio greater than -1 and less than 0.5. The id may be the "
            "name of a group of cells of the mesh file.");
        const auto material =
          from_young_poisson(std::stod(numbers[0]), std::stod(numbers[1]), std::stod(numbers[2]));
        if (!materials.emplace(id, material).second)
          throw InputError(origin + ": the material id " + std::to_string(id) + " is given twice.");
      }
    return materials;
  }


  void
  CorotationParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Corotation");
    add_choice(
      prm,
      "Rotation",
      rotation,
      {{"none", RotationMethod::none},
       {"gram-schmidt", RotationMethod::gram_schmidt},
       {"polar", RotationMethod::polar}},
      "How the rotation of a cell is taken from its deformation gradient. none is linear "
      "elasticity, "
      "right for small rotations only. polar is the nearest rotation. gram-schmidt is there for "
      "comparison: its force has no energy and depends on the orientation of the axes.");
    add(prm,
        "Warp tolerance",
        warp_tolerance,
        "degrees",
        Range::at_least(0),
        "The matrix of a step keeps the stiffness of cells that have turned by no more than this "
        "angle since it was taken; forces are always those of the rotations now. Where no cell has "
        "turned by more, matrix, factor and multigrid stay as they are. 0: all cells, in each "
        "step (doc/performance.md).");
    prm.leave_subsection();
  }


  void
  DampingParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Damping");
    add(prm,
        "Mass factor",
        mass_factor,
        "1/s",
        Range::at_least(0),
        "Rayleigh damping: a in D = a M + b K'.");
    add(prm,
        "Stiffness factor",
        stiffness_factor,
        "s",
        Range::at_least(0),
        "Rayleigh damping: b in D = a M + b K'.");
    add(prm,
        "Viscous",
        viscous,
        "N s/m",
        Range::at_least(0),
        "Damping coefficient of each vertex against a resting world.");
    prm.leave_subsection();
  }


  bool
  DampingParameters::any() const
  {
    return mass_factor > 0. || stiffness_factor > 0. || viscous > 0.;
  }
} // namespace Supple
