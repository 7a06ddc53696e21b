#include <supple/contact/tool_file.h>

#include <supple/base/error.h>
#include <supple/mesh/separate_process.h>

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <system_error>

namespace Supple
{
  namespace
  {
    /** Corners of triangles, nine numbers each. */
    std::vector<double>
    read_corners(const std::string &file)
    {
      const aiScene *const scene =
        aiImportFile(file.c_str(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
      if (!scene)
        throw InputError(std::string(aiGetErrorString()) + ".");
      std::vector<double> corners;
      for (unsigned int m = 0; m < scene->mNumMeshes; ++m)
        {
          const aiMesh &mesh = *scene->mMeshes[m];
          for (unsigned int f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned int v = 0; mesh.mFaces[f].mNumIndices == 3 && v < 3; ++v)
              {
                const aiVector3D &place = mesh.mVertices[mesh.mFaces[f].mIndices[v]];
                corners.insert(corners.end(), {place.x, place.y, place.z});
              }
        }
      aiReleaseImport(scene);
      return corners;
    }


    /** In a process of its own, for what the library makes of damaged files. */
    std::vector<double>
    read_corners_safely(const std::string &file)
    {
      constexpr std::size_t megabyte = 1000000;
      const std::size_t size         = std::filesystem::file_size(file);
      const std::string packed       = in_separate_process(
        [&] {
          const std::vector<double> corners = read_corners(file);
          return std::string(reinterpret_cast<const char *>(corners.data()),
                             corners.size() * sizeof(double));
        },
        {static_cast<unsigned int>(30 + size / megabyte), 1000 * megabyte + 100 * size});
      std::vector<double> corners(packed.size() / sizeof(double));
      std::memcpy(corners.data(), packed.data(), packed.size());
      return corners;
    }


    bool
    has_area(const TriangleMesh &mesh, const std::array<unsigned int, 3> &triangle)
    {
      dealii::Tensor<1, 3> u, v;
      for (unsigned int i = 0; i < 3; ++i)
        {
          u[i] = mesh.points[triangle[1]][i] - mesh.points[triangle[0]][i];
          v[i] = mesh.points[triangle[2]][i] - mesh.points[triangle[0]][i];
        }
      return dealii::cross_product_3d(u, v).norm() > 0.;
    }


    TriangleMesh
    join(const std::vector<double> &corners)
    {
      TriangleMesh mesh;
      std::map<std::array<double, 3>, unsigned int> numbers;
      for (std::size_t first = 0; first + 9 <= corners.size(); first += 9)
        {
          std::array<unsigned int, 3> triangle;
          for (unsigned int v = 0; v < 3; ++v)
            {
              const double *const x = &corners[first + 3 * v];
              const auto [found, is_new] =
                numbers.try_emplace({{x[0], x[1], x[2]}}, mesh.points.size());
              if (is_new)
                mesh.points.push_back(found->first);
              triangle[v] = found->second;
            }
          if (has_area(mesh, triangle))
            mesh.triangles.push_back(triangle);
        }
      return mesh;
    }
  } // namespace


  TriangleMesh
  read_triangles(const std::string &file, const std::string &origin)
  {
    const std::string ending = std::filesystem::path(file).extension().string();
    if (ending != ".stl" && ending != ".obj" && ending != ".ply")
      throw InputError(origin + ": '" + file +
                       "' is no surface of triangles that can be read: .stl, .obj or .ply.");
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(file, unknown))
      throw InputError(origin + ": there is no file '" + file + "'.");
    std::vector<double> corners;
    try
      {
        corners = read_corners_safely(file);
      }
    catch (const InputError &error)
      {
        throw InputError(origin + ": '" + file + "' can't be read: " + error.what());
      }
    catch (const SeparateProcessError &error)
      {
        throw InputError(origin + ": '" + file + "' is damaged: its reader fails on it (" +
                         error.what() + ").");
      }
    if (!std::all_of(corners.begin(), corners.end(), [](double x) { return std::isfinite(x); }))
      throw InputError(origin + ": places in '" + file + "' are not finite numbers.");
    const TriangleMesh mesh = join(corners);
    if (mesh.triangles.empty())
      throw InputError(origin + ": there are no triangles with an area in '" + file + "'.");
    return mesh;
  }
} // namespace Supple
