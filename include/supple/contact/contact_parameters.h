#ifndef supple_contact_parameters_h
#define supple_contact_parameters_h

#include <supple/base/hand_path.h>
#include <supple/contact/tool_file.h>
#include <supple/input/parameter_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Subsection Contact: how the body and the tools keep each other out. */
  struct ContactParameters
  {
    double stiffness       = 0.; ///< of the barrier [Pa]; 0: by the material
    double reach           = 0.; ///< of the barrier [m]; 0: by the mesh
    double guard           = 0.1;
    double slip_resolution = 1e-3; ///< below this speed friction sticks [m/s]

    enum class Bodies
    {
      tools,  ///< bodies meet tools alone
      pieces, ///< and each other
      all     ///< and themselves
    };
    Bodies bodies   = Bodies::tools;
    double friction = 0.; ///< between bodies, coefficient of Coulomb's law

    bool
    between_bodies() const
    {
      return bodies != Bodies::tools;
    }

    void
    declare(dealii::ParameterHandler &prm);
  };


  /** Subsections Tool NAME: a rigid body that moves as prescribed. */
  struct ToolParameters
  {
    enum class Shape
    {
      plane,
      sphere,
      capsule,
      box,
      file
    };

    std::string name;
    Shape shape          = Shape::sphere;
    std::string position = "0; 0; 0";           ///< of its reference point in time [m]
    std::string rotation = "0; 0; 0";           ///< about that point: axis times angle [degrees]
    dealii::Tensor<1, 3> normal{{0., 0., 1.}};  ///< of a plane, toward the body
    dealii::Tensor<1, 3> axis{{0., 0., 0.1}};   ///< of a capsule, from its tip on [m]
    double radius = 0.01;                       ///< [m]
    dealii::Tensor<1, 3> size{{0.1, 0.1, 0.1}}; ///< of a box [m]
    std::string file;                           ///< of its surface
    double scale    = 1.;                       ///< of the file [m]
    double friction = 0.;                       ///< coefficient of Coulomb's law

    /** No entry: of the reference point, from when on a hand moves it in place of the position;
     * null: never. */
    SharedHandPath hand;

    void
    declare(dealii::ParameterHandler &prm);

    /** The subsection of this tool. */
    std::string
    section() const;

    /** @throws InputError for a tool of no size */
    void
    check(const ParameterFile &scene) const;

    /** The surface in its file. @throws InputError */
    TriangleMesh
    read(const ParameterFile &scene) const;

  private:
    /** What tells each shape its size and direction. */
    void
    declare_shapes(dealii::ParameterHandler &prm);
  };


  /** Those of which a parameter file has a subsection, by name. @throws InputError for a name that
   * can't be part of the name of a file */
  std::vector<ToolParameters>
  tools_of(const ParameterFile &scene);
} // namespace Supple

#endif
