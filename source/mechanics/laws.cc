#include <supple/mechanics/laws.h>

#include <supple/mechanics/corotational.h>
#include <supple/mechanics/energies.h>
#include <supple/mechanics/hyperelastic.h>
#include <supple/mechanics/law_sweeps.h>
#include <supple/mechanics/quadratic_sweeps.h>

#include <map>

namespace Supple
{
  namespace
  {
    using Maker = std::unique_ptr<Law> (*)(const LawChoice &, RotationMethod, const Cells &);

    template <class Formulas>
    std::unique_ptr<Law>
    sweeps(const Formulas &formulas, const Cells &cells)
    {
      if (cells.is_quadratic())
        return std::make_unique<QuadraticSweeps<Formulas>>(formulas, cells);
      return std::make_unique<LawSweeps<Formulas>>(formulas, cells);
    }


    std::unique_ptr<Law>
    make_corotational(const LawChoice &, const RotationMethod rotation, const Cells &cells)
    {
      return sweeps(Corotational{rotation}, cells);
    }


    template <class Energy>
    std::unique_ptr<Law>
    make_hyperelastic(const LawChoice &choice, RotationMethod, const Cells &cells)
    {
      return sweeps(Hyperelastic<Energy>{Energy(choice)}, cells);
    }


    using LeastLambda = double (*)(const LawChoice &, const IsotropicMaterial &);

    /** What the list knows of a law. */
    struct Entry
    {
      Maker make;
      LeastLambda least_lambda;
    };


    template <class Energy>
    Entry
    hyperelastic()
    {
      return {make_hyperelastic<Energy>,
              [](const LawChoice &choice, const IsotropicMaterial &material) {
                return std::max(-Energy(choice).volume_term(0., material.mu),
                                material.deviatoric().lambda);
              }};
    }


    const std::map<std::string, Entry> &
    list()
    {
      static const std::map<std::string, Entry> list = {
        {"corotational",
         {make_corotational,
          [](const LawChoice &, const IsotropicMaterial &material) {
            return material.deviatoric().lambda;
          }}},
        {"fixed corotated", hyperelastic<FixedCorotated>()},
        {"mooney-rivlin", hyperelastic<MooneyRivlin>()},
        {"neo-hookean", hyperelastic<NeoHookean>()},
        {"st venant-kirchhoff", hyperelastic<SaintVenantKirchhoff>()},
        {"stable neo-hookean", hyperelastic<StableNeoHookean>()}};
      return list;
    }
  } // namespace


  double
  LawChoice::least_lambda(const IsotropicMaterial &material) const
  {
    return list().at(name).least_lambda(*this, material);
  }


  std::string
  names_of_laws()
  {
    std::string names;
    for (const auto &[name, entry] : list())
      names += (names.empty() ? "" : "|") + name;
    return names;
  }


  std::unique_ptr<Law>
  make_law(const LawChoice &choice, const RotationMethod rotation, const Cells &cells)
  {
    return list().at(choice.name).make(choice, rotation, cells);
  }
} // namespace Supple
