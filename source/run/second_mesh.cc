#include <supple/run/second_mesh.h>

#include <supple/base/error.h>
#include <supple/base/gather.h>
#include <supple/base/text.h>
#include <supple/mechanics/selection.h>
#include <supple/mechanics/vertex_values.h>
#include <supple/mesh/coarser_mesh.h>
#include <supple/run/chosen_vertices.h>
#include <supple/run/error_words.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    constexpr double smallest_order = 0.8; ///< to be believed

    // Distances of runs, as parts of the motion, from which on they tell no order, and no error.
    constexpr double far_for_order = 0.2;
    constexpr double far           = 0.5;

    /** What moves less than this part of the motion has no relative error to speak of. */
    constexpr double little = 0.01;

    /** "vertex 40" of a mesh as it is called on the coarser one. @throws InputError */
    void
    rename_vertex(std::string &text,
                  const std::vector<unsigned int> &shared,
                  const std::string &origin)
    {
      const std::string index = after_word(text, vertex_word);
      if (index.empty())
        return;
      const auto place = std::find(shared.begin(), shared.end(), Utilities::string_to_int(index));
      if (place == shared.end())
        throw InputError(origin + ": " + text +
                         " is not on a mesh of cells twice as large (Space/Second mesh); take "
                         "finer for that.");
      text = vertex_word + std::to_string(place - shared.begin());
    }


    double
    apart(const std::vector<double> &a,
          const std::size_t of_a,
          const std::vector<double> &b,
          const std::size_t of_b)
    {
      return std::hypot(a[3 * of_a] - b[3 * of_b],
                        a[3 * of_a + 1] - b[3 * of_b + 1],
                        a[3 * of_a + 2] - b[3 * of_b + 2]);
    }
  } // namespace


  Parameters
  SecondMesh::on_other_mesh(const Parameters &scene, const Kind kind, const std::string &origin)
  {
    Parameters other = Companion::scene(scene);
    other.probes     = ProbeParameters();
    if (kind == Kind::finer)
      {
        ++other.mesh.refinement.everywhere;
        return other;
      }
    if (kind == Kind::linear)
      {
        if (scene.mesh.order == 1)
          throw InputError(origin +
                           ": linear is for quadratic cells (Mesh/Order = 2); take "
                           "coarser or finer.");
        other.mesh.order = 1;
        return other;
      }
    const std::string obstacle = obstacle_to_coarser(scene.mesh);
    if (!obstacle.empty())
      throw InputError(origin + ": " + obstacle +
                       "; or take finer, at about eight times the work.");
    const std::vector<unsigned int> shared = vertices_of_coarser(scene.mesh);
    change_selections(other, [&](std::string &text, const std::string &where) {
      rename_vertex(text, shared, where);
    });
    other.mesh = coarser(scene.mesh);
    return other;
  }


  std::vector<unsigned int>
  SecondMesh::shared_vertices(const Parameters &scene, const Kind kind, const Body &body)
  {
    if (kind == Kind::coarser)
      return vertices_of_coarser(scene.mesh);
    std::vector<unsigned int> all(body.mesh.n_serial_vertices() - body.mesh.n_middles);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }


  SecondMesh::SecondMesh(const Body &body,
                         const Probes &probes,
                         const Kind kind,
                         const OtherRun &second,
                         const std::optional<OtherRun> &third,
                         const double &motion)
    : body(body)
    , kind(kind)
    , motion(motion)
    , shared_by_two(second.shared)
    , shared_by_three(third ? third->shared : std::vector<unsigned int>())
    , second(second.run)
  {
    if (third)
      this->third.emplace(third->run);
    follow(probes);
  }


  void
  SecondMesh::follow(const Probes &probes)
  {
    constexpr std::size_t none = -1;
    std::vector<std::size_t> place_there(body.mesh.n_serial_vertices(), none);
    for (std::size_t k = 0; k < shared_by_two.size(); ++k)
      place_there[shared_by_two[k]] = k;

    for (const Probes::Component &component : probes.displacement_components())
      {
        std::vector<std::size_t> own;
        for (const unsigned int dof : component.dofs)
          own.push_back(3 * std::size_t(body.serial_vertex[dof / 3]) + dof % 3);
        Followed probe{{}, component.weight};
        bool all_shared = true;
        for (const std::size_t place : gathered_on_first(own, body.mesh.communicator))
          {
            const std::size_t there = place_there[place / 3];
            all_shared              = all_shared && there != none;
            probe.places.push_back({{place, 3 * there + place % 3}});
          }
        if (!Utilities::MPI::broadcast(body.mesh.communicator, all_shared))
          continue;
        followed.push_back(probe);
        of_probes.push_back({component.name});
      }
  }


  bool
  SecondMesh::after_step(const Observation &now)
  {
    distance_now.reset();
    const auto there = second.move_to(now.measurement.time);
    const auto last  = third ? third->move_to(now.measurement.time) : decltype(there)();
    if (!there)
      return true;
    const auto by_vertex = [](const Body &of, const Vector &displacement) {
      return gathered_by_vertex(of, displacement.begin());
    };
    const Values of_first  = by_vertex(body, now.state.displacement);
    const Values of_second = by_vertex(there->body, there->displacement);
    const Values of_third  = last ? by_vertex(last->body, last->displacement) : Values();

    const MPI_Comm communicator = body.mesh.communicator;
    double between              = 0.;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      between = compare(of_first, of_second, of_third);
    between = Utilities::MPI::broadcast(communicator, between);
    if (std::isfinite(between))
      distance_now = between;
    else
      second.failure = "its motion is too large to be compared";
    return true;
  }


  double
  SecondMesh::compare(const Values &first, const Values &second, const Values &third)
  {
    double between = 0.;
    for (std::size_t k = 0; k < shared_by_two.size(); ++k)
      {
        const double here = apart(first, shared_by_two[k], second, k);
        if (!(here <= between))
          between = here;
      }
    largest = std::max(largest, between);
    for (std::size_t k = 0; k < shared_by_three.size() && !third.empty(); ++k)
      {
        const std::size_t v = shared_by_three[k];
        first_to_second     = std::max(first_to_second, apart(first, shared_by_two[v], second, v));
        second_to_third     = std::max(second_to_third, apart(second, v, third, k));
      }
    compare_probes(first, second);
    return between;
  }


  void
  SecondMesh::compare_probes(const Values &first, const Values &second)
  {
    for (std::size_t p = 0; p < followed.size(); ++p)
      {
        double difference = 0., sum = 0.;
        for (const auto &[here, there] : followed[p].places)
          {
            difference += followed[p].weight * (first[here] - second[there]);
            sum += followed[p].weight * first[here];
          }
        Error &error     = of_probes[p];
        error.at_the_end = difference;
        error.largest    = std::max(error.largest, std::abs(difference));
        error.of         = std::max(error.of, std::abs(sum));
      }
  }


  void
  SecondMesh::end(const Observation & /* now */)
  {
    second.require_meeting();
    std::vector<double> numbers = {largest, first_to_second, second_to_third};
    for (const Error &error : of_probes)
      numbers.insert(numbers.end(), {error.largest, error.of, error.at_the_end});
    numbers         = Utilities::MPI::broadcast(body.mesh.communicator, numbers);
    largest         = numbers[0];
    first_to_second = numbers[1];
    second_to_third = numbers[2];
    for (std::size_t p = 0; p < of_probes.size(); ++p)
      of_probes[p] = {of_probes[p].name,
                      std::abs(factor()) * numbers[3 * p + 3],
                      numbers[3 * p + 4],
                      factor() * numbers[3 * p + 5]};
  }


  nlohmann::json
  SecondMesh::save() const
  {
    nlohmann::json saved = {largest, first_to_second, second_to_third};
    for (const Error &error : of_probes)
      saved.insert(saved.end(), {error.largest, error.of});
    return saved;
  }


  void
  SecondMesh::load(const nlohmann::json &saved)
  {
    largest         = saved.at(0);
    first_to_second = saved.at(1);
    second_to_third = saved.at(2);
    for (std::size_t p = 0; p < of_probes.size(); ++p)
      {
        of_probes[p].largest = saved.at(3 + 2 * p);
        of_probes[p].of      = saved.at(4 + 2 * p);
      }
  }


  std::optional<double>
  SecondMesh::observed_order() const
  {
    if (!third || !third->failure.empty() || !(first_to_second > 0.) ||
        second_to_third > far_for_order * motion)
      return {};
    return std::log2(second_to_third / first_to_second);
  }


  SecondMesh::Orders
  SecondMesh::orders() const
  {
    return body.mesh.is_quadratic() ? Orders{1.5, 3.} : Orders{1.6, 2.};
  }


  bool
  SecondMesh::at_least() const
  {
    return largest > far * motion || (observed_order() && *observed_order() < smallest_order);
  }


  double
  SecondMesh::factor() const
  {
    if (kind == Kind::linear)
      return 1.;
    const auto [assumed, largest_order] = orders();
    const double order =
      at_least() ? largest_order : std::min(observed_order().value_or(assumed), largest_order);
    const double gain = std::pow(2., order);
    return kind == Kind::coarser ? 1. / (gain - 1.) : -gain / (gain - 1.);
  }


  double
  SecondMesh::error() const
  {
    return std::abs(factor()) * largest;
  }


  double
  SecondMesh::seconds() const
  {
    return second.seconds + (third ? third->seconds : 0.);
  }


  std::string
  SecondMesh::meshes_in_words() const
  {
    if (kind == Kind::linear)
      return "linear cells on the same vertices";
    if (kind == Kind::finer)
      return "cells half as large";
    return observed_order() ? "cells two and four times as large" : "cells twice as large";
  }


  std::string
  SecondMesh::in_words(const bool locks) const
  {
    if (!second.failure.empty())
      return "in space unknown by a second mesh, for the run on it failed: " + second.failure;
    if (!(motion > 0.))
      return "";
    if (kind == Kind::linear)
      return "in space less than " + percent_of(error() / motion) + " of the motion (" +
             meshes_in_words() + ")";
    const auto order = observed_order();
    std::string how  = meshes_in_words();
    if (order)
      how += ", order " + digits(*order, 2) +
             (at_least() ? " where it should be " + digits(orders().largest, 2) : "");
    else if (!at_least())
      how += ", order " + digits(orders().assumed, 2) + " assumed";
    return "in space " + part_of(error() / motion, at_least() || locks, "the motion") + " (" + how +
           (locks ? "; cells lock)" : ")");
  }


  nlohmann::ordered_json
  SecondMesh::to_json(const bool locks) const
  {
    nlohmann::ordered_json json = {{"mesh", meshes_in_words()}, {"seconds", seconds()}};
    if (!second.failure.empty())
      {
        json["failed"] = second.failure;
        return json;
      }
    json.update({{"distance", largest},
                 {"largest", error()},
                 {"relative", motion > 0. ? error() / motion : 0.},
                 {"at_least", kind != Kind::linear && (at_least() || locks)}});
    if (kind == Kind::linear)
      json["at_most"] = true;
    else if (observed_order())
      json["order"] = *observed_order();
    else if (!at_least())
      json["order_assumed"] = orders().assumed;
    if (third && !third->failure.empty())
      json["third_failed"] = third->failure;
    for (const Error &error : of_probes)
      if (error.of > little * motion)
        json["probes"][error.name] = {{"largest", error.largest},
                                      {"relative", error.largest / error.of},
                                      {"at_the_end", error.at_the_end}};
    return json;
  }
} // namespace Supple
