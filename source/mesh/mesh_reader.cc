#include <supple/mesh/mesh_reader.h>

#include <supple/base/error.h>
#include <supple/mesh/gmsh_reader.h>
#include <supple/mesh/mesh_format.h>
#include <supple/mesh/separate_process.h>
#include <supple/mesh/serial_mesh.h>
#include <supple/mesh/text_readers.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <filesystem>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** By the ending, which is one of a format that is read. */
    FileMesh
    read_any(const std::string &file)
    {
      const std::string ending = std::filesystem::path(file).extension().string();
      if (ending == ".vtk")
        return read_legacy_vtk(file);
      if (ending == ".vtu")
        return read_vtu(file);
      if (ending == ".unv")
        return read_universal(file);
      if (ending == ".mesh")
        return read_medit(file);
      if (ending == ".bdf" || ending == ".nas")
        return read_nastran(file);
      return read_gmsh(file);
    }


    /** A good mesh is read at megabytes a second, and takes less than fifty times its size. */
    ProcessLimits
    limits_for(const std::string &file)
    {
      const std::size_t size         = std::filesystem::file_size(file);
      constexpr std::size_t megabyte = 1000000;
      return {static_cast<unsigned int>(30 + 10 * (size / megabyte)), 1000 * megabyte + 200 * size};
    }
  } // namespace


  SerialMesh
  read_mesh(const std::string &file, const std::string &origin)
  {
    try
      {
        require_readable_format(file);
        // Gmsh's library crashes on some damaged files, and any reader may want too much memory.
        const std::string packed = in_separate_process(
          [&] {
            std::ostringstream stream;
            boost::archive::binary_oarchive(stream) << body_of(read_any(file));
            return stream.str();
          },
          limits_for(file));
        std::istringstream stream(packed);
        SerialMesh mesh;
        boost::archive::binary_iarchive(stream) >> mesh;
        return mesh;
      }
    catch (const InputError &error)
      {
        throw InputError(origin + ": " + error.what());
      }
    catch (const SeparateProcessError &error)
      {
        throw InputError(origin + ": the file is damaged, or no mesh: its reader fails on it (" +
                         error.what() + ").");
      }
  }
} // namespace Supple
