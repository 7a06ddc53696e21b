#include <supple/output/output_parameters.h>

#include <supple/input/entries.h>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  namespace
  {
    /** When frames are written, by each of OutputParameters::Frames. */
    void
    declare_frame_conditions(ParameterHandler &prm, OutputParameters &output)
    {
      add(prm,
          "Motion",
          output.motion,
          "fraction of the body's diameter",
          Range::between(0, infinity),
          "Adaptive: a frame is written when some vertex has moved this far since the last one.");
      add(
        prm,
        "Volume ratio change",
        output.volume_ratio_change,
        "none",
        Range::between(0, infinity),
        "Adaptive: a frame is written when the largest or smallest volume ratio passes that of all "
        "earlier frames by "
        "this much, and when the first cell is inverted.");
      add(prm,
          "Longest interval",
          output.longest_interval,
          "s",
          Range::at_least(0),
          "Adaptive: longest time without a frame; 0: no limit.");
      add(prm,
          "Every",
          output.every,
          "steps",
          Range::whole_number(1),
          "Frames = every: number of steps from frame to frame.");
      add(prm,
          "Interval",
          output.interval,
          "s",
          Range::between(0, infinity),
          "Frames = interval: time from frame to frame.");
    }
  } // namespace


  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    add(prm,
        "Folder",
        folder,
        "none",
        dealii::Patterns::Anything(),
        "Where results go; --output is stronger. Empty: output/ and the name of the scene.");
    add_choice(prm,
               "Frames",
               frames,
               {{"adaptive", Frames::adaptive},
                {"every", Frames::every},
                {"interval", Frames::interval},
                {"none", Frames::none}},
               "When a frame (VTU) is written: when something has happened, every so many steps, "
               "at intervals of time, "
               "or never. The first and the last state are always written, unless there are none.");
    declare_frame_conditions(prm, *this);
    add(prm,
        "History",
        history,
        "none",
        Range::one_of("true|false"),
        "Whether history.csv, probes.csv and profiles are written.");
    add(prm,
        "Report",
        report,
        "none",
        Range::one_of("true|false"),
        "Whether report.html, a page with the moving body and its history, is written at the end, "
        "from the frames and tables there are.");
    add(
      prm,
      "Mesh",
      mesh,
      "none",
      Range::one_of("true|false"),
      "Whether mesh.msh is written: the body at rest with the mesh of the run, as it was refined, "
      "with its ids and names, in m, for Gmsh, meshio or Mesh/File.");
    prm.leave_subsection();
  }


  void
  CheckpointParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Checkpoint");
    add(prm,
        "Every",
        every,
        "steps",
        Range::whole_number(0),
        "A checkpoint, from which the run can go on, is written after so many steps; 0: not by "
        "steps.");
    add(prm,
        "Minutes",
        minutes,
        "min",
        Range::at_least(0),
        "A checkpoint is written after so much time on the clock; 0: not by the clock. Where "
        "either is set, Ctrl-C and SIGTERM write one too.");
    add_choice(
      prm,
      "Resume",
      resume,
      {{"auto", true}, {"never", false}},
      "auto: go on from the checkpoint in the output folder, if there is one. never: begin anew.");
    prm.leave_subsection();
  }
} // namespace Supple
