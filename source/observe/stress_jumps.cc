#include <supple/observe/stress_jumps.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Supple
{
  namespace
  {
    using Vector3 = std::array<double, 3>;

    /** A face, or an edge in the plane, as one of its cells sees it. */
    struct Side
    {
      std::array<unsigned int, 2> others; ///< its nodes but the first, ascending; one twice
      Vector3 normal;                     ///< outward, as long as the face is large [m^2]
      Vector3 force;                      ///< P normal [N]
      double compliance;                  ///< 1/mu [1/Pa]
      unsigned int material;              ///< id
    };


    double
    norm_square(const Vector3 &v)
    {
      return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    }


    /**
     * The sides of all cells by the first of their nodes, which is the one with the least index in
     * the unpartitioned mesh. The owner of that node has both cells, so that it counts the face.
     */
    class Sides
    {
    public:
      Sides(const Body &body,
            const std::vector<Matrix3<Pack>> &piola,
            const std::function<bool(unsigned int)> &counts)
        : body(body)
        , piola(piola)
        , counts(counts)
        , n_nodes(body.cells->n_nodes)
        , start(body.n_owned + 1)
      {
        visit([&](const unsigned int first, std::size_t, unsigned int, unsigned int, std::size_t) {
          ++start[first + 1];
        });
        for (unsigned int node = 0; node < body.n_owned; ++node)
          start[node + 1] += start[node];
        list.resize(start.back());
        std::vector<std::size_t> end(start.begin(), start.end() - 1);
        visit([&](const unsigned int first,
                  const std::size_t b,
                  const unsigned int lane,
                  const unsigned int opposite,
                  const std::size_t cell) {
          list[end[first]]            = side(first, b, lane, opposite);
          list[end[first]++].material = body.cell_material[cell];
        });
      }

      double
      estimate() const
      {
        double sum = 0.;
        for (unsigned int node = 0; node < body.n_owned; ++node)
          for (std::size_t k = start[node]; k < start[node + 1]; ++k)
            for (std::size_t l = start[node]; l < k; ++l)
              if (list[k].others == list[l].others && list[k].material == list[l].material)
                sum += jump(node, list[k], list[l]);
        return sum;
      }

    private:
      /** Calls action(first node, batch, lane, opposite node, cell) for the sides of owned first
       * nodes of cells that count. */
      template <class Action>
      void
      visit(const Action &action) const
      {
        const Cells &cells = *body.cells;
        for (std::size_t b = 0; b < cells.n_batches(); ++b)
          cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
            if (!counts(body.cell_material[cell]))
              return;
            for (unsigned int opposite = 0; opposite < n_nodes; ++opposite)
              if (const unsigned int first = first_node(b, lane, opposite); first < body.n_owned)
                action(first, b, lane, opposite, cell);
          });
      }

      unsigned int
      first_node(const std::size_t b, const unsigned int lane, const unsigned int opposite) const
      {
        unsigned int first = dealii::numbers::invalid_unsigned_int;
        for (unsigned int a = 0; a < n_nodes; ++a)
          if (const unsigned int node = body.cells->batch(b).nodes[a][lane];
              a != opposite && (first == dealii::numbers::invalid_unsigned_int ||
                                body.serial_vertex[node] < body.serial_vertex[first]))
            first = node;
        return first;
      }

      /** The gradient of the shape function of a node points inward from the face opposite to it.
       */
      Side
      side(const unsigned int first,
           const std::size_t b,
           const unsigned int lane,
           const unsigned int opposite) const
      {
        const Cells::Batch &batch = body.cells->batch(b);
        Side side;
        unsigned int n = 0;
        for (unsigned int a = 0; a < n_nodes; ++a)
          if (a != opposite && batch.nodes[a][lane] != first)
            side.others[n++] = batch.nodes[a][lane];
        if (n == 1)
          side.others[1] = side.others[0];
        std::sort(side.others.begin(), side.others.end());
        for (unsigned int i = 0; i < 3; ++i)
          side.normal[i] =
            -double(n_nodes - 1) * batch.volume[lane] * batch.gradients[opposite][i][lane];
        for (unsigned int i = 0; i < 3; ++i)
          {
            side.force[i] = 0.;
            for (unsigned int j = 0; j < 3; ++j)
              side.force[i] += piola[b](i, j)[lane] * side.normal[j];
          }
        side.compliance = 1. / batch.mu[lane];
        return side;
      }

      double
      jump(const unsigned int first, const Side &one, const Side &other) const
      {
        Vector3 force, edge;
        for (unsigned int i = 0; i < 3; ++i)
          {
            force[i] = one.force[i] + other.force[i];
            edge[i]  = body.positions[first][i] - body.positions[one.others[0]][i];
          }
        const double area =
          0.5 * std::sqrt(norm_square(one.normal)) + 0.5 * std::sqrt(norm_square(other.normal));
        const double size = n_nodes == 4 ? std::sqrt(area) : std::sqrt(norm_square(edge));
        return size / area * norm_square(force) * (one.compliance + other.compliance) / 96.;
      }

      const Body &body;
      const std::vector<Matrix3<Pack>> &piola;
      const std::function<bool(unsigned int)> &counts;
      const unsigned int n_nodes;
      std::vector<std::size_t> start; ///< of each owned node in the list
      std::vector<Side> list;
    };
  } // namespace


  double
  jump_estimate(const Body &body,
                const std::vector<Matrix3<Pack>> &piola,
                const std::function<bool(unsigned int)> &counts)
  {
    return dealii::Utilities::MPI::sum(Sides(body, piola, counts).estimate(),
                                       body.mesh.communicator);
  }
} // namespace Supple
