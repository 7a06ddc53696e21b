#include <supple/mesh/mesh_format.h>

#include <supple/base/error.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace Supple
{
  namespace
  {
    const std::string read_are = "Read are .msh (Gmsh), .vtk, .vtu, .unv, .mesh, .bdf and .nas.";

    const std::set<std::string> readable =
      {".msh", ".vtk", ".vtu", ".unv", ".mesh", ".bdf", ".nas"};

    const std::set<std::string> surfaces = {".stl", ".obj", ".ply", ".off"};

    const std::set<std::string> of_nastran = {".dat", ".fem", ".inc", ".pch", ".blk"};

    const std::map<std::string, std::string> convertible = {
      {".meshb", "binary Medit"},
      {".inp", "Abaqus or AVS"},
      {".ele", "TetGen, which needs the .node file beside it"},
      {".node", "TetGen, which needs the .ele file beside it"},
      {".e", "Exodus"},
      {".exo", "Exodus"},
      {".xdmf", "XDMF"},
      {".xml", "Dolfin XML"},
      {".med", "Salome MED"},
      {".cgns", "CGNS"},
      {".f3grid", "FLAC3D"},
      {".avs", "AVS"},
      {".vol", "Netgen"}};


    /** In quotes if the shell wants them. */
    std::string
    shell_word(const std::string &text)
    {
      return text.find_first_of(" \t'\"$&;()*?<>|`\\") == std::string::npos ? text
                                                                            : "'" + text + "'";
    }


    std::string
    how_to_convert(const std::string &file)
    {
      const std::string to    = std::filesystem::path(file).replace_extension(".msh").string();
      const std::string files = shell_word(file) + " " + shell_word(to);
      return "Convert it by the script of Supple (package python3-meshio)\n"
             "  scripts/convert-mesh.py " +
             files + "\nor, without names of groups (package meshio-tools), by\n  meshio convert " +
             files + " --output-format gmsh22\nand take the ending .msh in Mesh/File.";
    }


    /** What follows # in a line of a parameter file is not read. */
    std::string
    hint_of_comment(const std::string &file)
    {
      namespace fs = std::filesystem;
      const fs::path path(file);
      std::error_code unreadable;
      for (const auto &entry :
           fs::directory_iterator(path.has_parent_path() ? path.parent_path() : fs::path("."),
                                  unreadable))
        if (const std::string name = entry.path().filename().string();
            name.rfind(path.filename().string() + "#", 0) == 0)
          return " There is " + name +
                 ", but # begins a comment in a parameter file: give the file another name.";
      return "";
    }


    std::string
    ending_of(const std::string &file)
    {
      std::string ending = std::filesystem::path(file).extension().string();
      if (ending.empty())
        throw InputError("the name has no ending that tells the format. " + read_are);
      const std::string written = ending;
      for (char &letter : ending)
        letter = std::tolower(static_cast<unsigned char>(letter));
      if (ending != written && readable.count(ending) > 0)
        throw InputError("write its ending in small letters: " + ending + ", not " + written + ".");
      return ending;
    }


    /** The first line that is not empty, without the blanks around it. */
    std::string
    first_line(const std::string &file)
    {
      std::ifstream stream(file);
      for (std::string line; std::getline(stream, line);)
        {
          line = dealii::Utilities::trim(line.substr(0, 200));
          if (!line.empty())
            return line;
        }
      throw InputError("the file is empty.");
    }


    void
    require_gmsh(const std::string &line)
    {
      for (const char *keyword : {"$MeshFormat", "$NOD", "$Comments", "$PhysicalNames"})
        if (line == keyword)
          return;
      throw InputError(
        "this is not a mesh that Gmsh has written: such a file begins with "
        "$MeshFormat.");
    }


    void
    require_legacy_vtk(const std::string &line, const std::string &file)
    {
      const std::string head = "# vtk DataFile Version ";
      if (line.rfind("<", 0) == 0)
        throw InputError("this is one of VTK's XML files: give it the ending .vtu.");
      if (line.rfind(head, 0) != 0)
        throw InputError("this is not a legacy VTK file: such a file begins with '" + head + "'.");
      if (line.size() > head.size() && line[head.size()] > '5')
        throw InputError("this is legacy VTK of version " + line.substr(head.size()) +
                         "; only versions up to 5.1 are read. " + how_to_convert(file));
    }


    void
    require_xml(const std::string &line)
    {
      if (line.rfind("# vtk DataFile Version ", 0) == 0)
        throw InputError("this is a legacy VTK file: give it the ending .vtk.");
      if (line.rfind("<", 0) != 0)
        throw InputError("this is none of VTK's XML files: such a file begins with <VTKFile.");
    }
  } // namespace


  void
  require_readable_format(const std::string &file)
  {
    namespace fs = std::filesystem;
    std::error_code unreadable; // a name that is too long is no exception
    if (fs::is_directory(file, unreadable))
      throw InputError("this is a folder.");
    if (!fs::is_regular_file(file, unreadable))
      throw InputError("there is no such file." + hint_of_comment(file));

    const std::string ending = ending_of(file);
    if (surfaces.count(ending) > 0)
      throw InputError("a " + ending +
                       " file holds a surface, which has no volume. Fill it with tetrahedra first, "
                       "for example in Gmsh (Create Volume, Mesh 3D), and save it as .msh.");
    const auto found = convertible.find(ending);
    if (found != convertible.end())
      throw InputError("this format (" + found->second + ") is not read. " + how_to_convert(file));
    if (of_nastran.count(ending) > 0)
      throw InputError(
        "the ending " + ending +
        " is of many formats. If it is Nastran's bulk data, give it the ending .bdf.");
    if (ending == ".pvtu")
      throw InputError(
        "a .pvtu file names the files of its parts. Save the mesh in one file (in "
        "ParaView: the filter Merge Blocks, then Save Data as .vtu).");
    if (readable.count(ending) == 0)
      throw InputError("the ending " + ending + " is not known. " + read_are);

    const std::string line = first_line(file);
    if (line.rfind("\xEF\xBB\xBF", 0) == 0)
      throw InputError(
        "it begins with a byte order mark, three bytes that some editors write. Save "
        "it without (as UTF-8 without BOM).");
    if (ending == ".msh")
      require_gmsh(line);
    else if (ending == ".vtk")
      require_legacy_vtk(line, file);
    else if (ending == ".vtu")
      require_xml(line);
  }
} // namespace Supple
