#include <supple/mesh/refinement.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/base/text.h>
#include <supple/mesh/mesh_check.h>
#include <supple/mesh/whole_mesh.h>

#include <cmath>

namespace Supple
{
  using dealii::Point;

  namespace
  {
    std::string
    coordinates_in_words(const Point<3> &point)
    {
      return digits(point[0], 6) + ", " + digits(point[1], 6) + ", " + digits(point[2], 6);
    }


    /** A mesh on its way to be refined. */
    class Refiner
    {
    public:
      Refiner(SerialMesh &mesh,
              const RefinementParameters &parameters,
              const BodyShape &shape,
              const ParameterFile &scene)
        : mesh(mesh)
        , parameters(parameters)
        , shape(shape)
        , scene(scene)
      {
      }

      void
      refine_region()
      {
        if (parameters.region.empty())
          return;
        const std::string origin = scene.origin("Mesh/Refine region");
        const Expression region(parameters.region, 1, origin);
        if (region.depends_on_time())
          throw InputError(origin + ": the body at rest does not depend on t.");
        const bool by_size = parameters.region_size > 0.;
        const unsigned int most =
          by_size ? dealii::numbers::invalid_unsigned_int : parameters.region_times;
        for (unsigned int round = 0; round < most; ++round)
          {
            const std::vector<Point<3>> places = shape.places(mesh);
            const std::vector<Selected> chosen = select(region, places, origin);
            Bisection bisection(mesh, places);
            bool any     = false;
            double total = mesh.cells.size(); // as far as can be told now
            for (const Selected &cell : chosen)
              {
                const double times =
                  by_size ? std::log2(cell.longest / parameters.region_size) : most - round;
                if (times <= round_off)
                  continue;
                any = true;
                total += std::pow(2., mesh.dimension * std::min(times, 300.)) - 1.;
                if (by_size)
                  bisection.mark_longest(cell.cell);
                else
                  bisection.mark_all(cell.cell);
              }
            if (!any)
              return;
            cut(bisection, total, origin);
          }
      }

      void
      refine_by_pilots()
      {
        for (const RefinementParameters::Pilot &pilot : parameters.pilots)
          {
            if (pilot.marked.empty())
              continue;
            Bisection bisection(mesh, shape.places(mesh));
            for (const unsigned int cell : pilot.marked)
              bisection.mark(cell);
            cut(bisection,
                0.,
                "The pilot run on " + std::to_string(pilot.cells) + " cells" +
                  (std::isfinite(pilot.error)
                     ? ", with an error of about " + digits(100. * pilot.error, 2) + " % of " +
                         pilot.of
                     : ""));
          }
      }

      void
      refine_everywhere()
      {
        for (unsigned int round = 0; round < parameters.everywhere; ++round)
          {
            Bisection bisection(mesh, shape.places(mesh));
            for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
              bisection.mark_all(cell);
            cut(bisection, 0., scene.origin("Space/Second mesh"));
          }
      }

    private:
      static constexpr double round_off = 1e-9;

      struct Selected
      {
        unsigned int cell;
        double longest; ///< edge [m]
      };

      /** The cells that touch the region. @throws InputError if there are none */
      std::vector<Selected>
      select(const Expression &region,
             const std::vector<Point<3>> &places,
             const std::string &origin) const
      {
        std::vector<bool> inside(places.size());
        for (std::size_t v = 0; v < places.size(); ++v)
          {
            const double value = region.value(places[v], 0.);
            if (!std::isfinite(value))
              throw InputError(origin + ": it is not a finite number at (" +
                               coordinates_in_words(places[v]) + ").");
            inside[v] = value > 0.;
          }
        std::vector<Selected> chosen;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          {
            Point<3> middle;
            bool touches   = false;
            double longest = 0.;
            for (const unsigned int v : mesh.cell_vertices(c))
              {
                middle += places[v] / (mesh.dimension + 1.);
                touches = touches || inside[v];
                for (const unsigned int w : mesh.cell_vertices(c))
                  longest = std::max(longest, places[v].distance(places[w]));
              }
            if (touches || region.value(middle, 0.) > 0.)
              chosen.push_back({c, longest});
          }
        if (chosen.empty())
          throw InputError(origin + ": it is greater than 0 at no vertex and at the middle of no " +
                           "cell. The body lies in " +
                           extent_in_words(box_around(mesh, places), mesh.dimension) + " m.");
        return chosen;
      }

      /** @param total cells in the end, as far as it is known
       * @param who asks for them, for messages */
      void
      cut(Bisection &bisection, const double total, const std::string &who)
      {
        bisection.close();
        const std::size_t n = bisection.n_cells();
        if (n > parameters.most_cells)
          throw InputError(who + ": the mesh would have " + (total > n ? "about " : "") +
                           digits(std::max<double>(total, n), total > n ? 2 : 10) + " cells, and " +
                           scene.origin("Mesh/Refine most cells") + " allows " +
                           std::to_string(parameters.most_cells) +
                           ". Allow more if there is memory, or refine less.");
        mesh                   = bisection.refined(shape.middle);
        std::size_t n_inverted = 0;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          n_inverted += !(mesh.volume(c) > 0.);
        if (n_inverted > 0)
          throw InputError(who + ": the mesh can't be refined: where new vertices are put on the " +
                           "curved wall, " + std::to_string(n_inverted) +
                           " cells are turned inside out. Begin with a finer mesh along the wall.");
      }

      SerialMesh &mesh;
      const RefinementParameters &parameters;
      const BodyShape &shape;
      const ParameterFile &scene;
    };
  } // namespace


  void
  refine(SerialMesh &mesh,
         const RefinementParameters &parameters,
         const BodyShape &shape,
         const ParameterFile &scene)
  {
    Refiner refiner(mesh, parameters, shape, scene);
    refiner.refine_region();
    shape.name_boundaries(mesh);
    refiner.refine_by_pilots();
    refiner.refine_everywhere();
  }


  Point<3>
  middle_of_edge(const Point<3> &a, const Point<3> &b)
  {
    return a + 0.5 * (b - a);
  }


  Point<3>
  middle_around_axis(const Point<3> &a, const Point<3> &b)
  {
    const double of_a = std::hypot(a[0], a[1]), of_b = std::hypot(b[0], b[1]);
    const double x = a[0] / of_a + b[0] / of_b, y = a[1] / of_a + b[1] / of_b;
    const double stretch = 0.5 * (of_a + of_b) / std::hypot(x, y);
    return {stretch * x, stretch * y, 0.5 * (a[2] + b[2])};
  }
} // namespace Supple
