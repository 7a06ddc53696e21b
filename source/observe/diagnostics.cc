#include <supple/observe/diagnostics.h>

#include <supple/forces/contact.h>
#include <supple/mechanics/rotation.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Supple
{
  using namespace dealii;

  double
  distance_from_shape(const Body &body, const Vector &displacement)
  {
    const MPI_Comm communicator = body.mesh.communicator;
    const auto place            = [&](const unsigned int node) {
      Tensor<1, 3> u;
      for (unsigned int i = 0; i < 3; ++i)
        u[i] = displacement.local_element(3 * node + i);
      return u + Tensor<1, 3>(body.position(node));
    };

    Tensor<1, 3> rest, now; // means
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        rest += Tensor<1, 3>(body.position(node));
        now += place(node);
      }
    const double n_nodes = Utilities::MPI::sum(double(body.n_owned), communicator);
    rest                 = Utilities::MPI::sum(rest, communicator) / n_nodes;
    now                  = Utilities::MPI::sum(now, communicator) / n_nodes;
    if (body.mesh.section.axisymmetric())
      for (const unsigned int i : {0, 2})
        rest[i] = now[i] = 0.;

    Tensor<2, 3> moments;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      moments += outer_product(place(node) - now, Tensor<1, 3>(body.position(node)) - rest);
    moments = Utilities::MPI::sum(moments, communicator);
    if (body.mesh.section.plane())
      moments[2][2] = moments.norm(); // a plane body is not turned over
    Matrix3<double> M = Matrix3<double>::identity();
    for (unsigned int k = 0; k < 9 && !body.mesh.section.axisymmetric(); ++k)
      M.entries[k] = moments[k / 3][k % 3];
    const Matrix3<double> R = nearest_rotation(M);

    double largest = 0.;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const Tensor<1, 3> arm = Tensor<1, 3>(body.position(node)) - rest;
        Tensor<1, 3> distance  = place(node) - now;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            distance[i] -= R(i, j) * arm[j];
        largest = std::max(largest, distance.norm());
      }
    return Utilities::MPI::max(largest, communicator);
  }


  Diagnostics::Diagnostics(const Configuration &configuration,
                           const Forces &forces,
                           const bool stationary)
    : configuration(configuration)
    , forces(forces)
    , stationary(stationary)
  {
  }


  void
  Diagnostics::note_extremes(const Measurement &measurement, const double rise)
  {
    sums.largest_energy =
      std::max({sums.largest_energy, std::abs(measurement.total), std::abs(sums.work)});
    sums.worst.min_volume_ratio =
      std::min(sums.worst.min_volume_ratio, measurement.min_volume_ratio);
    sums.worst.max_volume_ratio =
      std::max(sums.worst.max_volume_ratio, measurement.max_volume_ratio);
    sums.worst.most_inverted = std::max(sums.worst.most_inverted, measurement.inverted);
    if (rise > energy_accuracy * sums.largest_energy)
      {
        ++sums.worst.energy_rises;
        sums.worst.energy_risen += rise;
      }
    sums.most_dissipated = std::max(sums.most_dissipated, measurement.dissipated);
    sums.worst.energy_gained =
      std::max(sums.worst.energy_gained, sums.most_dissipated - measurement.dissipated);
    sums.worst.motion_energy =
      std::max(sums.worst.motion_energy, measurement.kinetic + measurement.elastic);
  }


  nlohmann::json
  Diagnostics::save() const
  {
    nlohmann::json saved = {{"elastic", sums.elastic},
                            {"total", sums.total},
                            {"dissipated", sums.dissipated},
                            {"most_dissipated", sums.most_dissipated},
                            {"work", sums.work},
                            {"largest_energy", sums.largest_energy},
                            {"energy_rises", sums.worst.energy_rises},
                            {"energy_risen", sums.worst.energy_risen},
                            {"energy_gained", sums.worst.energy_gained},
                            {"motion_energy", sums.worst.motion_energy},
                            {"most_inverted", sums.worst.most_inverted},
                            {"min_volume_ratio", sums.worst.min_volume_ratio},
                            {"max_volume_ratio", sums.worst.max_volume_ratio},
                            {"not_finite", sums.worst.not_finite}};
    if (forces.contact())
      {
        std::vector<double> works;
        for (const ToolReport &tool : sums.contact.tools)
          works.push_back(tool.work);
        saved["contact"] = {{"energy", sums.contact.energy},
                            {"rubbed", sums.contact.rubbed},
                            {"works", works},
                            {"releases", sums.worst.releases},
                            {"gaps", sums.worst.gaps}};
      }
    return saved;
  }


  void
  Diagnostics::load(const nlohmann::json &saved)
  {
    sums.first                  = false;
    sums.elastic                = saved.at("elastic");
    sums.total                  = saved.at("total");
    sums.dissipated             = saved.at("dissipated");
    sums.most_dissipated        = saved.at("most_dissipated");
    sums.work                   = saved.at("work");
    sums.largest_energy         = saved.at("largest_energy");
    sums.worst.energy_rises     = saved.at("energy_rises");
    sums.worst.energy_risen     = saved.at("energy_risen");
    sums.worst.energy_gained    = saved.at("energy_gained");
    sums.worst.motion_energy    = saved.at("motion_energy");
    sums.worst.most_inverted    = saved.at("most_inverted");
    sums.worst.min_volume_ratio = saved.at("min_volume_ratio");
    sums.worst.max_volume_ratio = saved.at("max_volume_ratio");
    sums.worst.not_finite       = saved.at("not_finite");
    if (forces.contact())
      {
        const nlohmann::json &of_tools = saved.at("contact");
        sums.contact.energy            = of_tools.at("energy");
        sums.contact.rubbed            = of_tools.at("rubbed");
        sums.worst.releases            = of_tools.at("releases");
        sums.worst.gaps                = of_tools.at("gaps").get<std::vector<double>>();
        sums.contact.tools.clear();
        for (const double done : of_tools.at("works"))
          {
            sums.contact.tools.emplace_back();
            sums.contact.tools.back().work = done;
          }
      }
  }


  void
  Diagnostics::book_change(const double time)
  {
    const Measurement now = measure_body(time, nullptr);
    sums.work += now.total - sums.total;
    sums.elastic = now.elastic;
    sums.total   = now.total;
    if (now.contact)
      sums.contact.energy = now.contact->energy;
  }


  Measurement
  Diagnostics::measure_body(const double time, const Vector *momentum) const
  {
    // A static scene has a part of the loads at time 1.
    Deformation deformation;
    const Energies energies =
      forces.energies(configuration, stationary ? 1. : time, stationary ? time : 1., deformation);

    MotionSums motion;
    if (configuration.state.has_velocity())
      {
        Vector product;
        if (momentum == nullptr)
          {
            configuration.body.initialize(product);
            configuration.body.set_mass_product(product, configuration.velocity());
            momentum = &product;
          }
        motion = configuration.body.cells->motion(configuration.displacement().begin(),
                                                  configuration.velocity().begin(),
                                                  momentum->begin());
      }
    const MPI_Comm communicator = configuration.body.mesh.communicator;
    std::vector<double> sums    = {motion.kinetic, double(deformation.inverted)};
    sums.insert(sums.end(), motion.linear_momentum.begin(), motion.linear_momentum.end());
    sums.insert(sums.end(), motion.angular_momentum.begin(), motion.angular_momentum.end());
    std::vector<double> global(sums.size());
    Utilities::MPI::sum(sums, communicator, global);

    Measurement result;
    result.kinetic          = global[0];
    result.inverted         = static_cast<unsigned int>(global[1]);
    result.linear_momentum  = {{global[2], global[3], global[4]}};
    result.angular_momentum = {{global[5], global[6], global[7]}};
    result.elastic          = energies.elastic;
    result.potential        = energies.potential;
    result.min_volume_ratio = Utilities::MPI::min(deformation.min_volume_ratio, communicator);
    result.max_volume_ratio = Utilities::MPI::max(deformation.max_volume_ratio, communicator);
    result.total            = result.kinetic + result.elastic + result.potential + energies.contact;
    if (forces.contact())
      {
        result.contact.emplace();
        result.contact->energy = energies.contact;
      }
    return result;
  }


  void
  Diagnostics::measure_contact(Measurement::Contact &now, const StepReport &report) const
  {
    now.tools                       = forces.contact()->reports(configuration);
    now.rubbed                      = sums.contact.rubbed + report.rubbed;
    const std::optional<double> own = forces.contact()->own_gap(configuration);
    const bool has_tools            = !now.tools.empty();
    now.min_gap                     = own.value_or(has_tools ? std::numeric_limits<double>::max()
                                         : forces.contact()->reach_between_bodies());
    now.creep                       = forces.contact()->creep(configuration);
    for (std::size_t t = 0; t < now.tools.size(); ++t)
      {
        now.min_gap = std::min(now.min_gap, now.tools[t].gap);
        if (t < sums.contact.tools.size())
          now.tools[t].work = sums.contact.tools[t].work;
        if (t < report.tool_works.size())
          now.tools[t].work += report.tool_works[t];
      }
  }


  void
  Diagnostics::note_contact(const Measurement::Contact &now)
  {
    sums.worst.releases += sums.contact.energy > 0. && now.energy == 0.;
    sums.worst.gaps.resize(now.tools.size(), std::numeric_limits<double>::max());
    for (std::size_t t = 0; t < now.tools.size(); ++t)
      sums.worst.gaps[t] = std::min(sums.worst.gaps[t], now.tools[t].gap);
    sums.contact = now;
  }


  Measurement
  Diagnostics::measure(const unsigned int step,
                       const double time,
                       const double seconds,
                       const StepReport &report)
  {
    before                   = sums;
    Measurement result       = measure_body(time, report.momentum);
    result.step              = step;
    result.time              = time;
    result.dt                = report.dt;
    result.newton_iterations = report.newton_iterations;
    result.linear_iterations = report.linear_iterations;
    result.seconds           = seconds;
    if (result.contact)
      measure_contact(*result.contact, report);

    result.dissipated = sums.dissipated - (stationary ? 0. : report.rubbed);
    if (!sums.first && report.expended)
      {
        result.dissipated += *report.expended - (result.elastic - sums.elastic);
        if (result.contact) // the tools have paid for a part of it
          result.dissipated += std::accumulate(report.tool_works.begin(),
                                               report.tool_works.end(),
                                               sums.contact.energy - result.contact->energy);
      }
    else if (!sums.first && !stationary)
      result.dissipated += report.load_work - (result.total - sums.total);
    else if (!sums.first)
      result.dissipated += forces.dissipated(configuration, 1.);
    result.work = sums.work + report.load_work;
    if (!result.not_finite().empty())
      {
        ++sums.worst.not_finite;
        return result;
      }

    note_extremes(result,
                  sums.first || stationary ? 0. : result.total - sums.total - report.load_work);
    if (result.contact)
      note_contact(*result.contact);
    sums.dissipated = result.dissipated;
    sums.work       = result.work;
    sums.elastic    = result.elastic;
    sums.total      = result.total;
    sums.first      = false;
    return result;
  }
} // namespace Supple
