// Contact of a body with tools and with itself: forces against differences of the barrier's energy,
// its tangent and the distances of all kinds of pairs against differences of forces and gradients,
// what may touch against all there is, and ways that are safe.

#include <supple/contact/barrier.h>
#include <supple/contact/contact_search.h>
#include <supple/contact/safe_way.h>
#include <supple/forces/contact.h>
#include <supple/forces/forces.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "driver/checks.h"

using namespace Supple;

namespace
{
  const std::string cube   = R"(
    subsection Mesh
      set Shape     = box
      set Box size  = 1, 1, 1
      set Box cubes = 2, 2, 2
    end
)";
  const std::string square = R"(
    subsection Mesh
      set Shape             = rectangle
      set Rectangle size    = 1, 1
      set Rectangle squares = 2, 2
    end
)";
  const std::string table  = R"(
    subsection Tool floor
      set Shape    = plane
      set Position = 0; 0.02; 0
      set Normal   = 0.05, 1, 0
    end
)";
  const std::string ball   = R"(
    subsection Tool ball
      set Shape    = sphere
      set Radius   = 0.4
      set Position = 1.37; 0.6; 0
    end
)";

  std::string
  capsule(const std::string &position, const std::string &axis)
  {
    return "subsection Tool needle\n set Shape = capsule\n set Radius = 0.1\n set Position = " +
           position + "\n set Axis = " + axis + "\nend\n";
  }


  const std::string box    = R"(
    subsection Tool box
      set Shape    = box
      set Size     = 0.4, 0.5, 0.6
      set Position = 0.7; 1.26; 0.4
      set Rotation = 3; 20; 2
    end
)";
  const std::string wedge  = R"(
    subsection Tool wedge
      set Shape    = file
      set File     = wedge.stl
      set Scale    = 0.1
      set Position = 0.55; 1.07; 0.5
      set Rotation = 0; 10; 0
    end
)";
  const std::string beside = R"(
    subsection Mesh
      set Shape      = box
      set Box size   = 1, 1, 1
      set Box cubes  = 2, 2, 2
      set Piece maps = x; y; z | 0.3 + 0.8*x + 0.05*z; 1.04 + y; 0.2 + 0.9*z - 0.03*x
    end
    subsection Contact
      set Bodies = pieces
    end
)";
  const std::string flat   = R"(
    subsection Mesh
      set Shape             = rectangle
      set Rectangle size    = 1, 1
      set Rectangle squares = 2, 2
      set Piece maps        = x; y; 0 | 0.3 + 0.8*x; 1.04 + y; 0
    end
    subsection Contact
      set Bodies = all
    end
)";


  /** A tetrahedron with an edge below. */
  void
  write_wedge()
  {
    const Arrow a({-3., 0., 0.5}), b({3., 0., -0.5}), c({-1., 4., -4.}), d({1., 4., 4.});
    std::ofstream file("wedge.stl");
    file << "solid wedge\n";
    for (const Corners &triangle :
         {Corners{{a, b, d}}, Corners{{a, c, b}}, Corners{{a, d, c}}, Corners{{b, c, d}}})
      {
        file << "facet normal 0 0 0\n outer loop\n";
        for (const Arrow &corner : triangle)
          file << "  vertex " << corner << "\n";
        file << " endloop\nendfacet\n";
      }
    file << "endsolid wedge\n";
  }


  /** A body that is somewhat deformed, and tools. */
  struct Touched
  {
    explicit Touched(const std::string &text)
      : parameters(read(text))
      , mesh(make_mesh(parameters, MPI_COMM_WORLD))
      , body(mesh, parameters.material, 1, parameters.file)
      , forces(body,
               parameters.material,
               parameters.corotation,
               parameters.damping,
               parameters.loads,
               parameters.contact,
               parameters.tools,
               parameters.file)
      , configuration(body, forces.elastic().cell_law(), false)
      , contact(*forces.contact())
      , surface(body)
    {
      Vector &u                = configuration.state.displacement;
      const unsigned int n_dim = body.mesh.section.plane() ? 2 : 3;
      for (unsigned int node = 0; node < body.n_owned; ++node)
        for (unsigned int i = 0; i < n_dim; ++i)
          u.local_element(3 * node + i) = 0.01 * std::sin(5. * node + 2. * i);
    }

    static Parameters
    read(const std::string &text)
    {
      std::ofstream("touched.prm") << text << "subsection Contact\n set Reach = 0.05\n"
                                   << " set Stiffness = 1\n set Guard = 0.3\nend\n";
      return read_scene("touched.prm");
    }

    std::vector<ContactPair>
    pairs()
    {
      const double *const u = configuration.displacement().begin();
      const PairFinder finder(surface, 0.3, 0.05);
      std::vector<ContactPair> pairs;
      for (unsigned int t = 0; t < contact.all_tools().size(); ++t)
        {
          const Tool &tool = contact.all_tools()[t];
          const Pose pose  = tool.pose(0.);
          finder.add(
            pairs, u, tool.placed(pose), t, candidates_of(surface, {u}, tool, {pose, pose}, 0.2));
        }
      if (parameters.contact.between_bodies())
        finder.add_own(pairs, u, own_candidates(surface, {u}, false, 0.2));
      return pairs;
    }

    const Parameters parameters;
    const Mesh mesh;
    const Body body;
    Forces forces;
    Configuration configuration;
    Contact &contact;
    ContactSurface surface;
  };


  /** How a pair may move, as a name. */
  std::string
  kind_of(const ContactPair &pair)
  {
    static const std::string parts[] = {"", "vertex", "edge", "face"};
    return parts[pair.part->n] + (pair.guards ? "" : " integrated") +
           (pair.other ? " and " + parts[pair.other->n] : "") + ", " + std::to_string(pair.n_free) +
           (pair.is_flat ? " free, plane" : " free");
  }


  void
  test_force(Touched &touched)
  {
    Vector f;
    touched.body.initialize(f);
    touched.contact.add_force(touched.configuration, 0., f.begin());
    double difference = 0.;
    for (unsigned int dof = 0; dof < f.size(); ++dof)
      {
        const auto energy_at = [&](const double step) {
          touched.configuration.state.displacement.local_element(dof) += step;
          const double energy = touched.contact.energy(touched.configuration, 0.);
          touched.configuration.state.displacement.local_element(dof) -= step;
          return energy;
        };
        const double slope = (energy_at(1e-6) - energy_at(-1e-6)) / 2e-6;
        difference         = std::max(difference, std::abs(slope + f.local_element(dof)));
      }
    if (touched.body.mesh.section.plane())
      std::printf(" plane body\n");
    report_larger("  force", f.l2_norm(), 1e-6);
    report("  difference over force", difference / f.l2_norm(), 1e-6);

    // action and reaction, torque and all
    dealii::Tensor<1, 3> force, torque;
    for (unsigned int node = 0; node < touched.body.n_owned; ++node)
      {
        dealii::Tensor<1, 3> x(touched.body.position(node)), here;
        for (unsigned int i = 0; i < 3; ++i)
          {
            x[i] += touched.configuration.displacement().local_element(3 * node + i);
            here[i] = f.local_element(3 * node + i);
          }
        force += here;
        torque += dealii::cross_product_3d(x, here);
      }
    for (const ToolReport &tool : touched.contact.reports(touched.configuration))
      {
        force -= tool.force;
        torque -= tool.torque + dealii::cross_product_3d(tool.place, tool.force);
      }
    report("  sum of forces less that of tools", force.norm() / f.l2_norm(), 1e-12);
    report("  the same of torques", torque.norm() / f.l2_norm(), 1e-12);
  }


  /** Of each kind of pair the worst second derivative of a distance. */
  void
  test_distances(Touched &touched, std::map<std::string, double> &worst)
  {
    constexpr double h                   = 1e-6;
    const std::vector<ContactPair> pairs = touched.pairs();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const ContactPair &pair = pairs[p];
        const PairMatrix matrix = second_derivative(pair);
        double difference       = 0.;
        bool same               = true;
        for (unsigned int k = 0; k < matrix.cols(); ++k)
          {
            Vector &u              = touched.configuration.state.displacement;
            const unsigned int dof = 3 * pair.nodes[k / 3] + k % 3;
            std::array<std::vector<double>, 2> gradients;
            for (unsigned int side = 0; side < 2; ++side)
              {
                u.local_element(dof) += side == 0 ? h : -h;
                const auto moved = touched.pairs();
                u.local_element(dof) -= side == 0 ? h : -h;
                same = same && moved.size() == pairs.size() && moved[p].part == pair.part &&
                       moved[p].n_free == pair.n_free && moved[p].other == pair.other;
                for (unsigned int l = 0; same && l < matrix.rows(); ++l)
                  gradients[side].push_back(moved[p].c[l / 3] * moved[p].normal[l % 3]);
              }
            for (unsigned int l = 0; same && l < matrix.rows(); ++l)
              difference =
                std::max(difference,
                         std::abs((gradients[0][l] - gradients[1][l]) / (2. * h) - matrix(l, k)));
          }
        if (same) // otherwise it is at a place where the kind changes
          {
            double &of_kind = worst[kind_of(pair)];
            of_kind         = std::max(of_kind, difference / std::max(1., matrix.norm()));
          }
      }
  }


  /** The tangent is that of the energy less its negative part, pair by pair. */
  void
  test_tangent(Touched &touched)
  {
    double negative = 0., missing = 0., rest = 0.;
    for (const ContactPair &pair : touched.pairs())
      {
        const Barrier barrier{pair.reach};
        const PairMatrix matrix = barrier_tangent(pair);
        Eigen::VectorXd gradient(matrix.rows());
        for (unsigned int k = 0; k < matrix.rows(); ++k)
          gradient[k] = pair.c[k / 3] * pair.normal[k % 3];
        const Eigen::MatrixXd whole =
          barrier.curvature(pair.gap) * gradient * gradient.transpose() +
          barrier.slope(pair.gap) * second_derivative(pair);
        const Eigen::VectorXd of_matrix =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
        const Eigen::VectorXd left =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix - whole).eigenvalues();
        const double size = matrix.norm() + whole.norm() + 1e-300;
        negative          = std::max(negative, -of_matrix.minCoeff() / size);
        if (!pair.guards && !pair.has_fixed_weights()) // its second derivative is left out
          continue;
        missing = std::max(missing, -left.minCoeff() / size);
        rest    = std::max(rest, std::abs((matrix * (matrix - whole)).norm()) / (size * size));
      }
    report("  negative part of the tangent", negative, 1e-12);
    report("  what it takes off is negative", missing, 1e-12);
    report("  and has nothing to do with the rest", rest, 1e-12);

    // add_product() against differences of the force along a way on which no pair bends
    Vector w, product, up, down;
    for (Vector *vector : {&w, &product, &up, &down})
      touched.body.initialize(*vector);
    for (unsigned int dof = 0; dof < w.size(); dof += 3)
      w.local_element(dof) = 1.; // a shift of the body: no edge turns
    touched.contact.update_tangent(Tangent::consistent, touched.configuration, 0., 1.);
    touched.contact.add_product(touched.configuration, {0., 0., 1.}, w.begin(), product.begin());
    for (const double sign : {1., -1.})
      {
        touched.configuration.state.displacement.add(sign * 1e-7, w);
        touched.contact.add_force(touched.configuration, 0., sign > 0. ? up.begin() : down.begin());
        touched.configuration.state.displacement.add(-sign * 1e-7, w);
      }
    down -= up;
    down *= 1. / 2e-7;
    report_larger("  w C w less w B'' w, over C w",
                  (product * w - down * w) / product.l2_norm(),
                  -1e-6);
  }


  /** Numbers between -size and size. */
  class Random
  {
  public:
    Arrow
    arrow(const double size)
    {
      return Arrow({size * number(generator), size * number(generator), size * number(generator)});
    }

    Simplex
    simplex(const unsigned int n, const double size)
    {
      return {n, corners(size)};
    }

    Corners
    corners(const double size)
    {
      return {{arrow(size), arrow(size), arrow(size)}};
    }

  private:
    std::mt19937 generator{1};
    std::uniform_real_distribution<double> number{-1., 1.};
  };


  /** Keeps the least gap on safe ways. */
  struct SafeWays
  {
    double least       = 1.; ///< over the gap at first
    unsigned int n_cut = 0;

    template <class Gap>
    void
    note(const double safe, const Gap &gap_at)
    {
      const double first = gap_at(0.);
      n_cut += safe < 1.;
      for (unsigned int k = 0; k <= 50; ++k)
        least = std::min(least, gap_at(k * safe / 50.) / first);
    }

    void
    print() const
    {
      report_larger("  least gap on the way over that at first", least, 0.);
      report_larger("  ways that are cut", n_cut, 100);
    }
  };


  /** Ways of vertices, edges and faces past tools that move and turn. */
  void
  test_safe_ways(const std::string &text)
  {
    const Touched touched(text);
    const Tool &tool = touched.contact.all_tools()[0];
    Random random;
    SafeWays ways;
    for (unsigned int n = 0; n < 3000; ++n)
      {
        const Pose from{random.arrow(0.3), random.arrow(1.)};
        const Pose to{from.place + random.arrow(2.), from.turn + random.arrow(2.)};
        const unsigned int kind    = n % 3;
        const SurfacePart *of_core = nullptr;
        if (!tool.is_plane())
          {
            const SurfaceParts &core = tool.shape->parts;
            const auto &list = kind == 0 ? core.faces() : kind == 1 ? core.edges : core.vertices;
            of_core          = &list[n % list.size()];
          }
        const Simplex x   = random.simplex(of_core ? kind + 1 : 1, 1.);
        const Corners way = random.corners(2.);
        const auto gap_at = [&](const double part) {
          const PlacedTool placed = tool.placed(between(from, to, part));
          const Simplex there     = x.moved(way, part);
          return of_core ? distance(there, of_core->at(placed.points)) - placed.offset
                         : placed.gap(there);
        };
        if (gap_at(0.) > 0.)
          ways.note(safe_part(x, way, tool, of_core, {from, to}), gap_at);
      }
    ways.print();
  }


  /** Ways of vertices past faces, and of edges past edges. */
  void
  test_safe_ways_of_surface()
  {
    Random random;
    SafeWays ways;
    for (unsigned int n = 0; n < 3000; ++n)
      {
        const bool edges = n % 2 == 0;
        const Simplex x = random.simplex(edges ? 2 : 1, 1.), y = random.simplex(edges ? 2 : 3, 1.);
        const Corners way = random.corners(2.), other_way = random.corners(2.);
        ways.note(safe_part(x, way, y, other_way), [&](const double part) {
          return distance(x.moved(way, part), y.moved(other_way, part));
        });
      }
    ways.print();
  }


  /** Whether lists have all pairs of parts that come nearer than a distance somewhere on a way. */
  template <class Distance>
  unsigned int
  n_missing(const std::vector<Candidate> &list,
            const std::size_t n_one,
            const std::size_t n_other,
            const Distance &comes_near)
  {
    std::set<std::pair<unsigned int, unsigned int>> found;
    for (const auto &[one, other] : list)
      found.insert({one, other});
    unsigned int n = 0;
    for (unsigned int one = 0; one < n_one; ++one)
      for (unsigned int other = 0; other < n_other; ++other)
        n += found.count({one, other}) == 0 && comes_near(one, other);
    return n;
  }


  void
  test_candidates(Touched &touched)
  {
    const Tool &tool      = touched.contact.all_tools()[0];
    const double *const u = touched.configuration.displacement().begin();
    Vector way;
    touched.body.initialize(way);
    for (unsigned int dof = 0; dof < way.size(); ++dof)
      way.local_element(dof) = 0.3 * std::sin(3. * dof);
    const Pose from = tool.pose(0.);
    const Pose to{from.place + Arrow({0.2, -0.3, 0.1}), from.turn + Arrow({0.3, 0.4, -0.2})};
    const ContactSurface &surface = touched.surface;
    const SurfaceParts &core      = tool.shape->parts;
    for (const bool moves : {false, true})
      {
        const Candidates found = candidates_of(
          surface, {u, moves ? way.begin() : nullptr}, tool, {from, moves ? to : from}, 0.1);
        const auto come_near = [&](const SurfacePart &one, const SurfacePart &other) {
          for (unsigned int k = 0; k <= (moves ? 20u : 0u); ++k)
            {
              const Corners ways      = ContactSurface::values(one, way.begin());
              const PlacedTool placed = tool.placed(between(from, to, k / 20.));
              const Simplex there     = surface.simplex(one, u).moved(ways, k / 20.);
              if (distance(there, other.at(placed.points)) - tool.offset < 0.1)
                return true;
            }
          return false;
        };
        const auto &faces = surface.faces();
        unsigned int n    = n_missing(found.vertex_face,
                                   surface.vertices.size(),
                                   core.faces().size(),
                                   [&](auto one, auto other) {
                                     return come_near(surface.vertices[one], core.faces()[other]);
                                   });
        n += n_missing(found.face_vertex,
                       faces.size(),
                       core.vertices.size(),
                       [&](auto one, auto other) {
                         return come_near(faces[one], core.vertices[other]);
                       });
        n += n_missing(found.edge_edge,
                       surface.edges.size(),
                       core.edges.size(),
                       [&](auto one, auto other) {
                         return come_near(surface.edges[one], core.edges[other]);
                       });
        report_larger("  found", found.vertex_face.size() + found.edge_edge.size(), 0);
        report("  missing", n, 0.);
      }
  }


  void
  test_own_candidates(Touched &touched)
  {
    const double *const u         = touched.configuration.displacement().begin();
    const ContactSurface &surface = touched.surface;
    const Candidates found        = own_candidates(surface, {u}, false, 0.15);
    const auto &faces             = surface.faces();
    const auto near               = [&](const SurfacePart &one, const SurfacePart &other) {
      return !one.shares_node_with(other) &&
             distance(surface.simplex(one, u), surface.simplex(other, u)) < 0.15;
    };
    unsigned int n =
      n_missing(found.vertex_face,
                surface.vertices.size(),
                faces.size(),
                [&](auto one, auto other) { return near(surface.vertices[one], faces[other]); });
    std::vector<Candidate> both = found.edge_edge;
    for (const auto &[one, other] : found.edge_edge)
      both.push_back({other, one});
    if (!surface.triangles.empty())
      n += n_missing(both, surface.edges.size(), surface.edges.size(), [&](auto one, auto other) {
        return near(surface.edges[one], surface.edges[other]);
      });
    report_larger("  found", found.vertex_face.size(), 0);
    report("  missing", n, 0.);
  }


  /** On a random walk of states and ways: what a search keeps gives the pairs of a fresh one. */
  void
  test_search(Touched &touched)
  {
    const std::vector<Tool> &tools = touched.contact.all_tools();
    const auto bodies              = touched.parameters.contact.bodies;
    ContactSearch kept(touched.surface, tools, 0.05, bodies);
    Random random;
    Vector &u = touched.configuration.state.displacement;
    Vector way;
    touched.body.initialize(way);
    std::vector<Pose> poses;
    for (const Tool &tool : tools)
      poses.push_back(tool.pose(0.));
    unsigned int n_pairs = 0, n_other = 0;
    for (unsigned int n = 0; n < 200; ++n)
      {
        const double size = n % 3 == 0 ? 0.05 : 0.002;
        for (unsigned int node = 0; node < touched.body.n_owned; ++node)
          for (unsigned int i = 0; i < (touched.body.mesh.section.plane() ? 2u : 3u); ++i)
            way.local_element(3 * node + i) = random.arrow(size)[i];
        std::vector<ToolMotion> motions;
        for (const Pose &pose : poses)
          motions.push_back(
            {pose, {pose.place + random.arrow(size), pose.turn + random.arrow(size)}});
        kept.find({u.begin(), way.begin()}, motions);
        const double part = n % 4 / 3.;
        u.add(part, way);
        for (std::size_t t = 0; t < poses.size(); ++t)
          poses[t] = between(motions[t].from, motions[t].to, part);
        const auto pairs_of = [&](const AllCandidates &candidates) {
          const PairFinder finder(touched.surface, 0.3, 0.05);
          std::vector<ContactPair> pairs;
          for (unsigned int t = 0; t < tools.size(); ++t)
            finder.add(pairs, u.begin(), tools[t].placed(poses[t]), t, candidates.of_tools[t]);
          finder.add_own(pairs, u.begin(), *candidates.own);
          return pairs;
        };
        ContactSearch fresh(touched.surface, tools, 0.05, bodies);
        const auto one = pairs_of(kept.find(u.begin(), poses));
        const auto two = pairs_of(fresh.find(u.begin(), poses));
        n_pairs += two.size();
        n_other += one.size() != two.size();
        for (std::size_t k = 0; k < std::min(one.size(), two.size()); ++k)
          n_other += one[k].gap != two[k].gap || one[k].part != two[k].part;
        u.add(-0.9 * part, way); // or it would drift apart
      }
    report_larger("  pairs", n_pairs, 100);
    report("  others than a fresh search gives", n_other, 0.);
  }


  void
  test_searches(const std::string &slanted, const std::string &in_plane)
  {
    for (const std::string &scene :
         {cube + ball, cube + slanted, cube + box, cube + wedge, square + in_plane})
      {
        std::printf("What may touch, at rest and on a way\n");
        Touched touched(scene);
        test_candidates(touched);
      }
    for (const std::string &scene : {cube + table, cube + box, square + ball, beside, flat})
      {
        std::printf("Searches that are kept\n");
        Touched touched(scene);
        test_search(touched);
      }
    for (const std::string &scene : {beside, flat})
      {
        std::printf("What may touch of the surface itself\n");
        Touched touched(scene);
        test_own_candidates(touched);
      }

    for (const std::string &scene : {cube + table, cube + ball, cube + slanted, cube + box})
      {
        std::printf("Safe ways\n");
        test_safe_ways(scene);
      }
    std::printf("Safe ways of the surface\n");
    test_safe_ways_of_surface();
  }
} // namespace


int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string slanted  = capsule("0.55; 1.075; 0.4", "0.3, 0.9, 0.2");
  const std::string lying    = capsule("-0.3; 1.07; 0.3", "1.5, 0.02, 0.45");
  const std::string in_plane = capsule("0.6; 1.075; 0", "0.3, 0.9, 0");

  std::printf("The barrier against differences\n");
  const Barrier barrier{0.3};
  double slope = 0., curvature = 0.;
  for (double gap = 0.01; gap < 0.4; gap += 0.013)
    {
      const double h = 1e-6;
      slope          = std::max(slope,
                       std::abs((barrier.value(gap + h) - barrier.value(gap - h)) / (2. * h) -
                                barrier.slope(gap)) /
                         (1. - barrier.slope(gap)));
      curvature      = std::max(curvature,
                           std::abs((barrier.slope(gap + h) - barrier.slope(gap - h)) / (2. * h) -
                                    barrier.curvature(gap)) /
                             (1. + barrier.curvature(gap)));
    }
  report("  slope", slope, 1e-7);
  report("  curvature", curvature, 1e-7);

  write_wedge();
  std::map<std::string, double> distances;
  for (const std::string &scene : {cube + table,
                                   cube + ball,
                                   cube + slanted,
                                   cube + lying,
                                   cube + box,
                                   cube + wedge,
                                   square + table,
                                   square + ball,
                                   square + in_plane,
                                   beside,
                                   flat})
    {
      Touched touched(scene);
      const auto &tools = touched.parameters.tools;
      std::printf("The force of %s against differences of the energy\n",
                  tools.empty() ? "other pieces" : tools[0].name.c_str());
      test_force(touched);
      test_tangent(touched);
      test_distances(touched, distances);
    }
  std::printf("Second derivatives of distances against differences\n");
  for (const auto &[kind, difference] : distances)
    report(("  " + kind).c_str(), difference, 1e-6);
  test_searches(slanted, in_plane);
}
