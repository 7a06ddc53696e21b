#ifndef supple_session_h
#define supple_session_h

#include <supple/base/csv_file.h>
#include <supple/live/hands.h>
#include <supple/live/motion.h>
#include <supple/run/simulation.h>

#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace Supple
{
  /**
   * A run in which hands move the body and change the scene between steps.
   *
   * What changes the equations has another Simulation go on from the present state, on the same
   * mesh and with the same files; the energy that it adds is booked as work. What was done is kept
   * as deeds, which do the same again. All functions are collective.
   */
  class Session
  {
  public:
    /** The scene with some entries changed. @throws InputError */
    using Scene = std::function<Parameters(const std::vector<Override> &)>;

    /**
     * @param first  the scene at the start, with its adapted mesh
     * @param scene  reads it anew
     * @param folder of the results; if empty, nothing is written
     * @param finer  0.5: half the step in time, or a tenth of the tolerance of variable steps
     * @throws InputError if a session can't run this scene
     */
    Session(const Parameters &first,
            const Scene &scene,
            const std::string &folder,
            bool quiet,
            double finer,
            MPI_Comm communicator);

    /** Throws InputError with the first of these deeds that can't be done, and why; to be called
     * before begin(). @param thoroughly with all that each scene on the way is made of */
    void
    check(const std::vector<Deed> &deeds, bool thoroughly);

    /** The same as Simulation::check(). */
    void
    check_start();

    /** Begins, or goes on from a checkpoint in the folder if the scene asks for it.
     * @param deeds of the run to go on from, which are done again up to there
     * @throws InputError as Simulation::run() */
    void
    begin(const std::vector<Deed> &deeds = {}, Listener *guest = nullptr);

    /** Does a deed between two steps. @throws InputError if it can't be done; nothing has changed
     * then */
    void
    act(const std::string &deed);

    /** Takes a step; where it fails the run has ended, as Simulation::step() says. @return whether
     * no listener asks to stop */
    bool
    step();

    /** Takes a step; where it fails, what was done since the last step is undone.
     * @throws ComputationError in the state before */
    bool
    try_step();

    /** Variable steps end at this time [s] at the latest. */
    void
    stop_at(double time);

    /** Says in the motion file how far the session has come: if it is killed, its repetition goes
     * so far. */
    void
    mark_progress();

    /** Completes all files. */
    void
    end();

    /** As Simulation::interrupt(), with what was done so far. */
    [[noreturn]] void
    interrupt();

    /** The run as it is now. */
    const Simulation &
    now() const
    {
      return *simulation;
    }

    /** All that was done and stands. */
    const std::vector<Deed> &
    deeds() const
    {
      return done;
    }

    /** What a hand does to a vertex. */
    struct Grip
    {
      unsigned int vertex;
      bool holds;
      dealii::Tensor<1, 3> target, place; ///< of hand and vertex [m]
      dealii::Tensor<1, 3> force;         ///< on the body [N]
      double stiffness;                   ///< of all its springs [N/m]; 0 if it holds
    };

    std::vector<Grip>
    grips() const;

    /** Whether a hand has this vertex. */
    bool
    has_in_hand(const unsigned int vertex) const
    {
      return hands.grabs(vertex) || hands.holds(vertex);
    }

    /** The deed that pulls a vertex, and those within a radius [m] of it at rest.
     * @param stiffness of its spring [N/m]; 0: ten times what the body opposes to it there
     * @throws InputError if there is nothing to pull */
    std::string
    grab(unsigned int vertex, double radius, double stiffness) const;

    /** The deed that holds a vertex where it is. @throws InputError */
    std::string
    hold(unsigned int vertex) const;

    /** The deed that takes a tool where it is; empty if that is done already. @throws InputError */
    std::string
    take(const std::string &tool) const;

    const Parameters &
    scene() const
    {
      return first;
    }

  private:
    /** With all that hands have changed, and hold. @throws InputError */
    Parameters
    present_scene() const;

    /** Has another Simulation go on, with the present scene. @throws InputError if that is wrong;
     * nothing has changed then */
    void
    renew();

    /** What was done since the last step stands. */
    void
    keep_deeds();

    void
    write_grips();

    void
    begin_motion_file(const std::vector<Deed> &deeds);

    /** Into the motion file, if there is one. @throws WriteError */
    void
    write_deed(const Deed &deed);

    dealii::Point<3>
    place_of(unsigned int vertex) const;

    /** Three numbers of a vertex; those of the process that has it. */
    dealii::Tensor<1, 3>
    value_at(unsigned int vertex, const Vector &values) const;

    /** @throws InputError if the mesh has no such vertex */
    void
    require_vertex(unsigned int vertex) const;

    /** The same of all that hands have. */
    void
    require_vertices(const Hands &of_hands) const;

    /** @throws InputError if the scene holds this vertex */
    void
    require_free(unsigned int vertex) const;

    const Parameters first;
    const Scene read;
    const std::string folder;
    const bool quiet;
    const double finer;
    const MPI_Comm communicator;
    std::unordered_map<unsigned int, unsigned int> own_nodes; ///< by the index in the mesh
    Hands hands, hands_before;                                ///< now, and after the last step
    std::vector<Deed> done, new_deeds;                        ///< new: since the last step
    std::unique_ptr<Simulation> simulation;
    Listener *guest = nullptr;
    double stop     = 0.;                 ///< of variable steps; 0: none
    std::ofstream motion_file;            ///< on the first process
    std::unique_ptr<CsvFile> grips_table; ///< on the first process
  };


  /** A scene without the other runs that tell its error: they would know nothing of hands. */
  Parameters
  alone(Parameters scene);


  /** The names of the files of a session in its folder. */
  inline const std::string motion_file_name = "session.motion", repeated_scene_name = "live.prm";


  /** The columns of hands.csv. */
  std::vector<std::string>
  grip_columns();
} // namespace Supple

#endif
