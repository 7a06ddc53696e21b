#include <supple/mechanics/laws.h>

#include <supple/mechanics/corotational.h>
#include <supple/mechanics/law_sweeps.h>
#include <supple/mechanics/quadratic_sweeps.h>

#include <map>

namespace Supple
{
  namespace
  {
    using Maker = std::unique_ptr<Law> (*)(RotationMethod, const Cells &);

    template <class Formulas>
    std::unique_ptr<Law>
    make(const RotationMethod rotation, const Cells &cells)
    {
      if (cells.is_quadratic())
        return std::make_unique<QuadraticSweeps<Formulas>>(Formulas{rotation}, cells);
      return std::make_unique<LawSweeps<Formulas>>(Formulas{rotation}, cells);
    }


    const std::map<std::string, Maker> &
    makers()
    {
      static const std::map<std::string, Maker> list = {{"corotational", make<Corotational>}};
      return list;
    }
  } // namespace


  std::string
  names_of_laws()
  {
    std::string names;
    for (const auto &[name, maker] : makers())
      names += (names.empty() ? "" : "|") + name;
    return names;
  }


  std::unique_ptr<Law>
  make_law(const std::string &name, const RotationMethod rotation, const Cells &cells)
  {
    return makers().at(name)(rotation, cells);
  }
} // namespace Supple
