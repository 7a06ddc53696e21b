#ifndef supple_second_mesh_h
#define supple_second_mesh_h

#include <supple/observe/probes.h>
#include <supple/run/companion.h>
#include <supple/run/listener.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * The error in space of a run from its distance to a run of the same scene, with the same steps,
   * on a mesh whose cells are twice as large, or half as large. Where the error falls with the
   * power p of the size of the cells,
   *
   *   exact - u_h = (u_h - u_2h) / (2^p - 1) = (u_{h/2} - u_h) 2^p / (2^p - 1)
   *
   * at the vertices that both meshes have. A third run on cells four times as large tells p, by the
   * largest distances over the run (Roache 1998). Without one 1.6 is taken, for linear cells have 2
   * where the stress is smooth and less at edges, and 1.5 for quadratic ones, which have 3 at best
   * and at edges no more than linear ones; and so where the two coarser runs are farther apart than
   * a fifth of the motion, for such meshes are too coarse for any order. Where the first two are
   * farther apart than half of it, as swings are that have lost their phase, or distances do not
   * shrink from mesh to mesh, the error is known from below alone.
   *
   * Quadratic cells have a third companion, linear cells on the same vertices: the distance is the
   * error of those, of which quadratic cells have a small part.
   */
  class SecondMesh : public Listener
  {
  public:
    using Kind = SpaceParameters::SecondMesh;

    /** The companion of a run on another mesh. */
    struct OtherRun
    {
      Companion::Run run;
      std::vector<unsigned int> shared; ///< vertices of the first mesh that the first ones here are
    };

    /** An error of a number over the run. */
    struct Error
    {
      std::string name;       ///< of a column of probes.csv
      double largest    = 0.; ///< over the run [m]
      double of         = 0.; ///< the number's largest size over the run [m]
      double at_the_end = 0.; ///< what the number lacks [m]
    };

    /** A scene on its other mesh. @param origin of the entry that asks for it
     * @throws InputError where there is none, or where a vertex by its index is not there */
    static Parameters
    on_other_mesh(const Parameters &scene, Kind kind, const std::string &origin);

    /** The vertices of the run's mesh that its companion's has too, see OtherRun. */
    static std::vector<unsigned int>
    shared_vertices(const Parameters &scene, Kind kind, const Body &body);

    /** @param third is empty, or follows @p second as that follows the run
     *  @param motion largest of a vertex so far [m]; it changes, and must outlive this */
    SecondMesh(const Body &body,
               const Probes &probes,
               Kind kind,
               const OtherRun &second,
               const std::optional<OtherRun> &third,
               const double &motion);

    /** Moves the other runs up to the time of this state. */
    bool
    after_step(const Observation &now) override;

    void
    end(const Observation &now) override;

    std::string
    name() const override
    {
      return "second mesh";
    }

    nlohmann::json
    save() const override;

    void
    load(const nlohmann::json &saved) override;

    /** Of the two meshes after the last step, largest over the vertices they share [m]; nothing
     * where the two runs are not at the same time. */
    const std::optional<double> &
    distance() const
    {
      return distance_now;
    }

    /** Largest over the vertices and over the run [m]; at least that, if the meshes are too coarse
     * for any order. */
    double
    error() const;

    /** p, if three runs tell it. */
    std::optional<double>
    observed_order() const;

    /** The error may be much larger. */
    bool
    at_least() const;

    /** "in space about 19 % of the motion (cells twice as large, order 1.6 assumed)"
     * @param locks cells lock, so that the error is more than two meshes show */
    std::string
    in_words(bool locks) const;

    nlohmann::ordered_json
    to_json(bool locks) const;

    double
    seconds() const;

  private:
    /** How the error falls with the size of the cells. */
    struct Orders
    {
      double assumed; ///< where it is not observed
      double largest; ///< where all is smooth
    };

    Orders
    orders() const;

    /** Displacements by vertex, on the first process [m]. */
    using Values = std::vector<double>;

    /** The displacement of a probe on the first process. */
    struct Followed
    {
      std::vector<std::array<std::size_t, 2>> places; ///< in Values of the run and its companion
      double weight;
    };

    /** To be called on the first process. @return the largest distance of the first two runs */
    double
    compare(const Values &first, const Values &second, const Values &third);

    void
    compare_probes(const Values &first, const Values &second);

    void
    follow(const Probes &probes);

    /** What differences of the first two runs are to be multiplied with. */
    double
    factor() const;

    /** "cells twice as large" */
    std::string
    meshes_in_words() const;

    const Body &body;
    const Kind kind;
    const double &motion; ///< largest of a vertex so far [m]
    const std::vector<unsigned int> shared_by_two, shared_by_three;
    Companion second;
    std::optional<Companion> third;
    std::vector<Followed> followed;
    std::vector<Error> of_probes; ///< differences, until end() makes errors of them
    std::optional<double> distance_now;
    double largest = 0.; ///< distance of the first two so far [m]
    /** Distances at the vertices that all three share, of the first two and of the last two. */
    double first_to_second = 0., second_to_third = 0.;
  };
} // namespace Supple

#endif
