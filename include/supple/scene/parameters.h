#ifndef supple_parameters_h
#define supple_parameters_h

#include <supple/input/parameter_file.h>
#include <supple/mechanics/material.h>
#include <supple/mechanics/rotation.h>
#include <supple/mesh/section.h>

#include <deal.II/base/point.h>

#include <array>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace Supple
{
  struct Parameters;

  struct MeshParameters
  {
    enum class Shape
    {
      box,
      hollow_cylinder,
      rectangle,
      file
    };

    /** How the squares of a rectangle are cut in two. */
    enum class Split
    {
      falling,
      rising,
      alternating
    };

    Shape shape = Shape::box;

    dealii::Point<3> origin{0., 0., 0.};
    dealii::Point<3> size{1., 1., 1.};
    std::array<unsigned int, 3> cubes{{4, 4, 4}};

    double inner_radius  = 0.3;
    double outer_radius  = 0.4;
    double height        = 1.;
    unsigned int sectors = 15;
    unsigned int rings   = 6;
    unsigned int layers  = 1;

    dealii::Point<2> rectangle_origin{0., 0.};
    dealii::Point<2> rectangle_size{1., 1.};
    std::array<unsigned int, 2> squares{{8, 8}};
    Split split = Split::falling;

    std::vector<double> material_layers;  ///< thicknesses from the top (largest y) downward [m]
    std::vector<unsigned int> layer_rows; ///< of cubes or squares in each layer; may be empty

    std::string file; ///< as written; relative to the folder of the scene
    double scale = 1.;
    std::string boundary_regions;
    std::string map; ///< where vertices are put; empty: they stay

    void
    declare(dealii::ParameterHandler &prm);

    void
    check(const Parameters &parameters) const;

    /** Where rows of cubes or squares end along y, from the bottom: one more than there are, from 0
     * to the height [m]. */
    std::vector<double>
    ends_of_rows(double height, unsigned int n_rows) const;

    /** The material id of each row, from the bottom. */
    std::vector<unsigned int>
    material_of_rows(const std::vector<double> &ends) const;

    /** Of a box or a rectangle along y, and how many cubes or squares it has there. */
    std::pair<double, unsigned int>
    height_and_rows() const;

  private:
    void
    declare_cylinder(dealii::ParameterHandler &prm);

    void
    declare_rectangle(dealii::ParameterHandler &prm);

    /** And where vertices are put. */
    void
    declare_layers(dealii::ParameterHandler &prm);

    void
    declare_file(dealii::ParameterHandler &prm);

    void
    check_cylinder(const Parameters &parameters) const;

    void
    check_layers(const Parameters &parameters) const;

    void
    check_layer_rows(const Parameters &parameters) const;
  };


  /** What is in front of and behind a body of triangles. */
  struct PlaneParameters
  {
    Section section{Geometry::plane_strain, 1.};

    void
    declare(dealii::ParameterHandler &prm);

    /** @throws InputError for a thickness that would count for nothing */
    void
    check(const Parameters &parameters) const;
  };


  struct MaterialParameters
  {
    enum class Constants
    {
      young_poisson,
      lame
    };

    enum class LockingCure
    {
      none,
      patches
    };

    Constants constants          = Constants::young_poisson;
    LockingCure cure             = LockingCure::none;
    VolumeMeasure volume_measure = VolumeMeasure::determinant; ///< of patches
    double young                 = 1e6;
    double poisson               = 0.3;
    double lambda                = 1e6;
    double mu                    = 1e6;
    double density               = 1000.;
    bool lumped                  = false;
    double vertex_mass           = 0.; ///< [kg]; if positive, densities count for nothing
    std::string by_id;                 ///< as written

    void
    declare(dealii::ParameterHandler &prm);

    /** What holds for cells whose material id is not in the list below. */
    IsotropicMaterial
    preset() const;

    /** Materials of their own by id, checked. @throws InputError */
    std::map<unsigned int, IsotropicMaterial>
    exceptions(const std::string &origin) const;
  };


  struct CorotationParameters
  {
    RotationMethod rotation = RotationMethod::polar;
    double warp_tolerance   = 0.; ///< [degrees]

    void
    declare(dealii::ParameterHandler &prm);

    /** @throws InputError where a tolerance means nothing */
    void
    check(const Parameters &parameters) const;
  };


  /** D = mass_factor M + stiffness_factor K' + viscous I. */
  struct DampingParameters
  {
    double mass_factor      = 0.; ///< [1/s]
    double stiffness_factor = 0.; ///< [s]
    double viscous          = 0.; ///< [N s/m] at each node

    void
    declare(dealii::ParameterHandler &prm);

    bool
    any() const;
  };


  struct ConstraintParameters
  {
    std::vector<unsigned int> clamped_boundaries;
    std::string clamped_region;
    std::array<std::vector<unsigned int>, 3> sliding_boundaries; ///< held along x, along y, along z

    void
    declare(dealii::ParameterHandler &prm);
  };


  /** A prescribed displacement. */
  struct MotionParameters
  {
    std::string of; ///< which vertices, as written; empty: there is no such motion
    std::string displacement = "0; 0; 0"; ///< three expressions, or the word free

    void
    declare(dealii::ParameterHandler &prm, const std::string &section);
  };


  struct LoadParameters
  {
    dealii::Tensor<1, 3> gravity;
    std::string body_force     = "0; 0; 0"; ///< [N/m^3]
    std::string nodal_force    = "0; 0; 0"; ///< [N]
    std::string nodal_force_on = "all";
    std::string traction       = "0; 0; 0"; ///< [Pa]
    std::vector<unsigned int> traction_on;
    std::string pressure = "0"; ///< [Pa]
    std::vector<unsigned int> pressure_on;
    bool pressure_follows = true;

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct StartParameters
  {
    std::string displacement = "0; 0; 0";
    std::string velocity     = "0; 0; 0";
    dealii::Tensor<1, 3> rotation;    ///< axis times angle [degrees]
    dealii::Point<3> rotation_center; ///< [m]

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct TimeParameters
  {
    enum class Problem
    {
      dynamic,
      stationary
    };

    enum class Method
    {
      backward_euler,
      implicit_backward_euler,
      implicit_midpoint,
      sdirk2,
      trbdf2,
      esdirk3,
      esdirk4,
      esdirk5,
      explicit2,
      explicit3,
      explicit4,
      explicit5,
      ida
    };

    enum class EnergyGuard
    {
      off,
      warn,
      reject
    };

    enum class TangentChoice
    {
      automatic,
      frozen,
      consistent,
      definite
    };

    Problem problem               = Problem::dynamic;
    Method method                 = Method::backward_euler;
    double step                   = 0.01;
    unsigned int n_steps          = 100;
    bool adaptive                 = false;
    double relative_tolerance     = 1e-3;
    double displacement_tolerance = 0.; ///< [m]; 0: by the size of the body
    double velocity_tolerance     = 0.; ///< [m/s]; 0: from that of the displacement
    double longest_step           = 0.; ///< [s]; 0: any
    unsigned int maximum_order    = 2;  ///< of IDA
    TangentChoice tangent         = TangentChoice::automatic;
    double newton_tolerance       = 1e-8;
    unsigned int newton_limit     = 100;
    unsigned int n_retries        = 10;
    EnergyGuard energy_guard      = EnergyGuard::off;
    bool estimate_error           = false; ///< by a second run

    void
    declare(dealii::ParameterHandler &prm);

    void
    check(const Parameters &parameters) const;

    /** As it is written. */
    std::string
    method_name() const;

    bool
    is_explicit() const;

    /** With which power of the step the error falls; of ida its maximum order. */
    unsigned int
    order() const;

    bool
    has_variable_steps() const;

    /** The time at the end [s]; the load factor of a static problem. */
    double
    end() const;

    /** So short a time [s] that differences over it are derivatives, and so long that round-off is
     * small beside them. */
    double
    derivative_interval() const;

  private:
    void
    declare_tolerances(dealii::ParameterHandler &prm);

    void
    declare_newton(dealii::ParameterHandler &prm);
  };


  struct SolverParameters
  {
    enum class Method
    {
      automatic,
      ldlt,
      cholmod,
      cg_amg,
      cg_ml,
      cg_jacobi
    };

    Method method                = Method::automatic;
    double tolerance             = 1e-8;
    unsigned int iteration_limit = 5000;
    unsigned int threads         = 1;

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct OutputParameters
  {
    enum class Frames
    {
      adaptive,
      every,
      interval,
      none
    };

    std::string folder;
    Frames frames              = Frames::adaptive;
    double motion              = 0.02;
    double volume_ratio_change = 0.1;
    double longest_interval    = 0.;
    unsigned int every         = 1;
    double interval            = 0.1;
    bool history               = true;
    bool report                = true;

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct ProbeParameters
  {
    std::string points;
    std::string boundaries;
    std::string regions;
    std::string profiles;
    dealii::Point<3> profile_center{0., 0., 0.};
    unsigned int profile_every = 1;

    void
    declare(dealii::ParameterHandler &prm);
  };


  struct CheckpointParameters
  {
    unsigned int every = 0;  ///< steps; 0: never
    double minutes     = 0.; ///< of wall time; 0: never
    bool resume        = false;

    void
    declare(dealii::ParameterHandler &prm);

    bool
    wanted() const
    {
      return every > 0 || minutes > 0.;
    }
  };


  /**
   * Everything a scene file can say, one struct per subsection. Nothing else in the program reads a
   * parameter file.
   */
  struct Parameters
  {
    MeshParameters mesh;
    PlaneParameters plane;
    MaterialParameters material;
    CorotationParameters corotation;
    DampingParameters damping;
    ConstraintParameters constraints;
    std::array<MotionParameters, 4> motions;
    LoadParameters loads;
    StartParameters start;
    TimeParameters time;
    SolverParameters solver;
    OutputParameters output;
    ProbeParameters probes;
    CheckpointParameters checkpoint;

    std::string scene_name;   ///< of the file, without folder and ending
    std::string scene_folder; ///< where files that the scene names are looked for

    /**
     * Reads a scene file and applies @p overrides on top.
     * @throws InputError with file, line, entry, what was found and what would be right.
     */
    static Parameters
    read(const std::string &file, const std::vector<Override> &overrides = {});

    /** The subsection of a motion: Motion, Motion 2, ... */
    static std::string
    motion_section(unsigned int motion);

    /** Where results go unless the command line says otherwise: output/ and the name of the scene.
     */
    std::string
    output_folder() const;

    /** Where an entry ("Section/Entry") got its value, and the value: to begin a message with. */
    std::string
    origin(const std::string &entry) const;

    /** Every parameter as used, in a form that read() takes. */
    void
    print(std::ostream &out) const;

    /** Every entry with its default, unit, range and meaning; @p format is "prm" or "json". */
    static void
    print_reference(std::ostream &out, const std::string &format);

  private:
    void
    declare(dealii::ParameterHandler &prm);

    void
    check() const;

    ParameterFile file;
    std::string as_used;
  };


  /** A run of "name: text; name: text" taken apart, in its order. @throws InputError */
  std::vector<std::pair<std::string, std::string>>
  named_list(const std::string &text, const std::string &origin);


  /** The boundary id that is the whole of a text. @throws InputError beginning with @p origin */
  unsigned int
  boundary_id(const std::string &text, const std::string &origin);
} // namespace Supple

#endif
