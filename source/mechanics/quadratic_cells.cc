#include <supple/mechanics/quadratic_cells.h>

namespace Supple
{
  namespace Quadratic
  {
    NodalPack
    mass_product(const Pack &mass, const bool lumped, const NodalPack &values)
    {
      NodalPack products;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < 3; ++i)
          {
            Pack sum(0.);
            if (lumped)
              sum = share(a, true) * values[a][i];
            else
              for (unsigned int b = 0; b < n_nodes; ++b)
                sum += product(a, b) * values[b][i];
            products[a][i] = mass * sum;
          }
      return products;
    }
  } // namespace Quadratic
} // namespace Supple
