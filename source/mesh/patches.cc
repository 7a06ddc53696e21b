#include <supple/mesh/patches.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

namespace Supple
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /** For each cell those of the same material on the other side of its faces. */
    std::vector<std::vector<unsigned int>>
    find_neighbours(const SerialMesh &mesh)
    {
      const std::vector<SerialMesh::CellFace> faces = mesh.sorted_faces();
      std::vector<std::vector<unsigned int>> neighbours(mesh.cells.size());
      for (std::size_t k = 1; k < faces.size(); ++k)
        {
          const unsigned int a = faces[k - 1].cell, b = faces[k].cell;
          if (faces[k - 1].vertices == faces[k].vertices && mesh.materials[a] == mesh.materials[b])
            {
              neighbours[a].push_back(b);
              neighbours[b].push_back(a);
            }
        }
      return neighbours;
    }


    class Grouping
    {
    public:
      explicit Grouping(const SerialMesh &mesh)
        : mesh(mesh)
        , full_size(mesh.dimension == 2    ? 4
                    : mesh.middles.empty() ? 8
                                           : 12)
        , smallest_size(full_size / 2)
        , neighbours(find_neighbours(mesh))
        , patch(mesh.cells.size(), none)
      {
        for (const auto &list : neighbours)
          n_free.push_back(list.size());
      }

      std::vector<unsigned int>
      run()
      {
        // A patch begins where the fewest cells are left around: so few of them stay behind.
        using Entry = std::pair<unsigned int, unsigned int>; // free neighbours, cell
        std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
        for (unsigned int c = 0; c < patch.size(); ++c)
          queue.emplace(n_free[c], c);
        while (!queue.empty())
          {
            const auto [n, cell] = queue.top();
            queue.pop();
            if (patch[cell] != none)
              continue;
            if (n != n_free[cell])
              queue.emplace(n_free[cell], cell);
            else
              grow(cell);
          }
        while (merge())
          ;
        return renumbered();
      }

    private:
      void
      grow(const unsigned int seed)
      {
        std::vector<unsigned int> members, vertices;
        for (unsigned int next = seed; next != none; next = best_neighbour(members, vertices))
          {
            patch[next] = sizes.size();
            members.push_back(next);
            for (const unsigned int v : mesh.cell_vertices(next))
              if (std::find(vertices.begin(), vertices.end(), v) == vertices.end())
                vertices.push_back(v);
            for (const unsigned int neighbour : neighbours[next])
              --n_free[neighbour];
            if (members.size() == full_size)
              break;
          }
        sizes.push_back(members.size());
      }

      /** The next cell of a patch; `none` if there is no free one. */
      unsigned int
      best_neighbour(const std::vector<unsigned int> &members,
                     const std::vector<unsigned int> &vertices) const
      {
        dealii::Point<3> center;
        for (const unsigned int v : vertices)
          center += mesh.vertices[v] / double(vertices.size());

        const double unit = mesh.vertices[vertices[0]].distance_square(mesh.vertices[vertices[1]]);
        unsigned int best = none;
        std::tuple<unsigned int, int, unsigned int, long, unsigned int> lowest;
        for (const unsigned int member : members)
          for (const unsigned int cell : neighbours[member])
            {
              if (patch[cell] != none)
                continue;
              unsigned int n_new = 0;
              double distance    = 0.;
              for (const unsigned int v : mesh.cell_vertices(cell))
                {
                  n_new += std::find(vertices.begin(), vertices.end(), v) == vertices.end();
                  distance += center.distance_square(mesh.vertices[v]);
                }
              const int n_shared =
                std::count_if(neighbours[cell].begin(),
                              neighbours[cell].end(),
                              [&](const unsigned int c) { return patch[c] == patch[members[0]]; });
              // In symmetric meshes many are as far away: round-off is not to choose among them.
              const long steps = std::lround(1048576. * distance / unit);
              const auto key   = std::make_tuple(n_new, -n_shared, n_free[cell], steps, cell);
              if (best == none || key < lowest)
                {
                  best   = cell;
                  lowest = key;
                }
            }
        return best;
      }

      /** Moves cells of small patches to the smallest neighbouring patch that is not small; false
       * if there is nothing to move. */
      bool
      merge()
      {
        bool moved = false;
        for (unsigned int c = 0; c < patch.size(); ++c)
          {
            if (sizes[patch[c]] >= smallest_size)
              continue;
            unsigned int target = none;
            for (const unsigned int neighbour : neighbours[c])
              {
                const unsigned int p = patch[neighbour];
                if (sizes[p] >= smallest_size &&
                    (target == none || std::tie(sizes[p], p) < std::tie(sizes[target], target)))
                  target = p;
              }
            if (target == none)
              continue;
            --sizes[patch[c]];
            ++sizes[target];
            patch[c] = target;
            moved    = true;
          }
        return moved;
      }

      std::vector<unsigned int>
      renumbered() const
      {
        std::vector<unsigned int> number(sizes.size(), none), result;
        unsigned int n = 0;
        for (const unsigned int p : patch)
          {
            if (number[p] == none)
              number[p] = n++;
            result.push_back(number[p]);
          }
        return result;
      }

      const SerialMesh &mesh;
      const unsigned int full_size, smallest_size; ///< cells of a patch
      const std::vector<std::vector<unsigned int>> neighbours;
      std::vector<unsigned int> n_free; ///< neighbours of a cell without a patch
      std::vector<unsigned int> patch;
      std::vector<unsigned int> sizes;
    };
  } // namespace


  std::vector<unsigned int>
  make_patches(const SerialMesh &mesh)
  {
    return Grouping(mesh).run();
  }
} // namespace Supple
