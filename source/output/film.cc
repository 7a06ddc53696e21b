#include <supple/output/film.h>

#include <supple/base/error.h>
#include <supple/base/gather.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <numeric>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Where each of these comes to stand when they are sorted. */
    template <class Key>
    std::vector<unsigned int>
    places_when_sorted(const std::vector<Key> &keys)
    {
      std::vector<unsigned int> order(keys.size()), place(keys.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return keys[a] < keys[b];
      });
      for (unsigned int i = 0; i < order.size(); ++i)
        place[order[i]] = i;
      return place;
    }


    /** So many of them, first and last included, as far apart as they can be. */
    std::vector<unsigned int>
    spread(const unsigned int n_taken, const unsigned int n)
    {
      std::vector<unsigned int> taken;
      for (unsigned int i = 0; i < n_taken; ++i)
        taken.push_back(n_taken == 1 ? 0 : std::size_t(i) * (n - 1) / (n_taken - 1));
      return taken;
    }
  } // namespace


  namespace
  {
    /** The four triangles between the corners and the middles of the edges of a face. */
    std::array<LocalFace, 4>
    quarters(const LocalFace &face, const std::array<unsigned int, 3> &middles)
    {
      std::array<LocalFace, 4> parts;
      parts.fill(face);
      for (unsigned int v = 0; v < 3; ++v)
        parts[v].nodes = {{face.nodes[v], middles[v], middles[(v + 2) % 3]}};
      parts[3].nodes = middles;
      return parts;
    }
  } // namespace


  namespace
  {
    const std::string of_contact = "contact_pressure", of_errors = "error_in_space";


    std::vector<std::string>
    names_of_fields(const bool with_contact, const bool with_errors)
    {
      std::vector<std::string> names = {"volume_ratio", "von_mises_stress"};
      if (with_contact)
        names.push_back(of_contact);
      if (with_errors)
        names.push_back(of_errors);
      return names;
    }


    std::string
    joined(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += " " + name;
      return text;
    }
  } // namespace


  Film::Film(const Body &body,
             const std::string &folder,
             const bool with_contact,
             const bool with_errors)
    : body(body)
    , file(folder + "/" + file_name())
    , fields(names_of_fields(with_contact, with_errors))
    , magic("supple frames of" + joined(fields) + "\n")
    , root(Utilities::MPI::this_mpi_process(body.mesh.communicator) == 0)
  {
    find_surface();
    gather_surface();
  }


  std::string
  Film::file_name()
  {
    return "report.frames";
  }


  void
  Film::find_surface()
  {
    const DistributedMesh &parts = *body.mesh.parts;
    std::vector<bool> on_surface(body.n_local, false);
    std::vector<unsigned int> material_of(parts.n_cells);
    const auto add = [&](const auto &part, const unsigned int cell_index) {
      const std::array<unsigned int, 3> nodes = {{part.nodes[0], part.nodes[1], part.nodes[2]}};
      for (const unsigned int node : nodes)
        on_surface[node] = true;
      if (part.owned)
        own_triangles.push_back({nodes, cell_index, material_of[cell_index]});
    };
    for (const LocalCell &cell : parts.cells)
      {
        material_of[cell.index] = cell.material_id;
        if (body.mesh.section.plane())
          add(cell, cell.index);
      }
    if (parts.is_quadratic())
      for (std::size_t f = 0; f < parts.faces.size(); ++f)
        for (const LocalFace &part : quarters(parts.faces[f], parts.face_middles[f]))
          add(part, part.cell_index);
    else if (!body.mesh.section.plane())
      for (const LocalFace &face : parts.faces)
        add(face, face.cell_index);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (on_surface[node])
        own_nodes.push_back(node);
  }


  void
  Film::gather_surface()
  {
    std::vector<unsigned int> vertices, corners;
    std::vector<float> positions;
    for (const unsigned int node : own_nodes)
      {
        vertices.push_back(body.serial_vertex[node]);
        positions.insert(positions.end(), body.positions[node].begin(), body.positions[node].end());
      }
    std::vector<unsigned int> unsorted_materials;
    for (const Triangle &triangle : own_triangles)
      {
        for (const unsigned int node : triangle.nodes)
          corners.push_back(body.serial_vertex[node]);
        unsorted_materials.push_back(triangle.material);
      }

    const MPI_Comm communicator = body.mesh.communicator;
    vertices                    = gathered_on_first(vertices, communicator);
    corners                     = gathered_on_first(corners, communicator);
    positions                   = gathered_on_first(positions, communicator);
    unsorted_materials          = gathered_on_first(unsorted_materials, communicator);
    if (root)
      sort_surface(vertices, positions, corners, unsorted_materials);
  }


  void
  Film::sort_surface(std::vector<unsigned int> vertices,
                     const std::vector<float> &positions,
                     const std::vector<unsigned int> &corners,
                     const std::vector<unsigned int> &unsorted_materials)
  {
    vertex_place = places_when_sorted(vertices);
    rest.resize(positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
      std::copy_n(&positions[3 * i], 3, &rest[3 * vertex_place[i]]);
    std::sort(vertices.begin(), vertices.end());
    std::vector<std::array<unsigned int, 3>> unsorted(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i)
      unsorted[i / 3][i % 3] =
        std::lower_bound(vertices.begin(), vertices.end(), corners[i]) - vertices.begin();
    for (std::array<unsigned int, 3> &triangle : unsorted) // deal.II may begin with any of them
      std::rotate(triangle.begin(),
                  std::min_element(triangle.begin(), triangle.end()),
                  triangle.end());
    triangle_place = places_when_sorted(unsorted);
    triangles.resize(unsorted.size());
    materials.resize(unsorted.size());
    for (std::size_t i = 0; i < unsorted.size(); ++i)
      {
        triangles[triangle_place[i]] = unsorted[i];
        materials[triangle_place[i]] = unsorted_materials[i];
      }
  }


  std::size_t
  Film::head_size() const
  {
    return magic.size() + sizeof(std::uint64_t);
  }


  std::size_t
  Film::frame_size() const
  {
    return 2 * sizeof(double) + (rest.size() + fields.size() * triangles.size()) * sizeof(float);
  }


  void
  Film::open(const bool anew)
  {
    stream.open(file, std::ios::binary | (anew ? std::ios::trunc : std::ios::app));
    if (anew)
      {
        stream << magic;
        stream.write(reinterpret_cast<const char *>(&n_missing), sizeof(n_missing));
      }
  }


  void
  Film::resume(const unsigned int n_before)
  {
    n_frames  = 0;
    n_missing = n_before;
    if (!root)
      return;
    std::string head(magic.size(), ' ');
    std::uint64_t missing = n_before + 1ul;
    std::ifstream old(file, std::ios::binary);
    old.read(head.data(), head.size());
    old.read(reinterpret_cast<char *>(&missing), sizeof(missing));
    if (!old || head != magic || missing > n_before)
      return; // the next frame begins a new file
    const std::size_t size = head_size() + (n_before - missing) * frame_size();
    std::error_code problem;
    if (std::filesystem::file_size(file, problem) < size || problem)
      return;
    std::filesystem::resize_file(file, size, problem);
    if (problem)
      return;
    n_missing = missing;
    n_frames  = n_before - missing;
    open(false);
  }


  std::vector<float>
  Film::own_values(const std::string &name, const Drawing &drawing) const
  {
    std::vector<float> values;
    values.reserve(own_triangles.size());
    if (name == of_contact)
      {
        const GhostValues pressure(*drawing.contact_pressure);
        for (const auto &[nodes, cell_index, material] : own_triangles)
          values.push_back((pressure.data()[3 * nodes[0]] + pressure.data()[3 * nodes[1]] +
                            pressure.data()[3 * nodes[2]]) /
                           3.);
        return values;
      }
    const std::vector<float> *of_cells = drawing.error_in_space;
    for (const auto &[name_of_cells, values_of_cells] : drawing.cells.named())
      if (name == name_of_cells)
        of_cells = values_of_cells;
    for (const Triangle &triangle : own_triangles)
      values.push_back(of_cells ? (*of_cells)[triangle.cell_index] : 0.f);
    return values;
  }


  std::vector<float>
  Film::gather_fields(const Drawing &drawing) const
  {
    std::vector<float> all;
    for (std::size_t f = 0; f < fields.size(); ++f)
      {
        const std::vector<float> here =
          gathered_on_first(own_values(fields[f], drawing), body.mesh.communicator);
        all.resize(all.size() + triangle_place.size());
        for (std::size_t i = 0; i < triangle_place.size(); ++i)
          all[f * triangle_place.size() + triangle_place[i]] = here[i];
      }
    return all;
  }


  void
  Film::write(const Drawing &drawing)
  {
    std::vector<float> nodal;
    nodal.reserve(3 * own_nodes.size());
    for (const unsigned int node : own_nodes)
      for (unsigned int d = 0; d < 3; ++d)
        nodal.push_back(drawing.displacement.local_element(3 * node + d));
    nodal                           = gathered_on_first(nodal, body.mesh.communicator);
    const std::vector<float> fields = gather_fields(drawing);
    if (!root)
      return;

    std::vector<float> values(rest.size());
    for (std::size_t i = 0; i < vertex_place.size(); ++i)
      std::copy_n(&nodal[3 * i], 3, &values[3 * vertex_place[i]]);
    values.insert(values.end(), fields.begin(), fields.end());
    if (!stream.is_open())
      open(true);
    const std::array<double, 2> when = {{drawing.time, double(drawing.step)}};
    stream.write(reinterpret_cast<const char *>(when.data()), sizeof(when));
    stream.write(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(float));
    stream << std::flush;
    if (!stream)
      throw WriteError(file + " can't be written any more; is the disk full?");
    ++n_frames;
  }


  FilmFrame
  Film::read_frame(std::ifstream &stream, const unsigned int number) const
  {
    FilmFrame frame;
    frame.displacement.resize(rest.size());
    frame.cells.resize(fields.size() * triangles.size());
    stream.seekg(head_size() + number * frame_size());
    stream.read(reinterpret_cast<char *>(&frame.time), sizeof(double));
    stream.read(reinterpret_cast<char *>(&frame.step), sizeof(double));
    for (std::vector<float> *values : {&frame.displacement, &frame.cells})
      stream.read(reinterpret_cast<char *>(values->data()), values->size() * sizeof(float));
    if (!stream)
      throw WriteError(file + " can't be read.");
    return frame;
  }


  std::vector<FilmFrame>
  Film::read_frames(const unsigned int n_taken) const
  {
    std::ifstream stream(file, std::ios::binary);
    std::vector<FilmFrame> frames;
    for (const unsigned int number : spread(n_taken, n_frames))
      frames.push_back(read_frame(stream, number));
    return frames;
  }


  PackedFilm
  Film::pack(const std::size_t limit) const
  {
    constexpr std::size_t largest_ratio = 4; // of plain bytes to packed ones
    PackedFilm packed(rest, triangles, materials, fields);
    packed.n_written        = n_frames;
    const std::size_t begin = packed.bytes.size();
    const std::size_t room  = limit > begin ? limit - begin : 0;
    const std::size_t size =
      (rest.size() + fields.size() * triangles.size()) * sizeof(std::uint16_t);
    for (std::size_t n_taken = std::min<std::size_t>(n_frames, largest_ratio * room / size);;)
      {
        n_taken = std::max<std::size_t>(n_taken, std::min(n_frames, 2u));
        packed.set_frames(read_frames(n_taken));
        const std::size_t used = packed.bytes.size() - begin;
        if (used <= room || n_taken <= 2)
          return packed;
        n_taken = std::min<std::size_t>(n_taken - 1, 0.98 * n_taken * room / used);
      }
  }


  void
  Film::remove() const
  {
    std::error_code nothing_there;
    if (root)
      std::filesystem::remove(file, nothing_there);
  }
} // namespace Supple
