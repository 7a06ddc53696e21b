#include <supple/output/film.h>

#include <supple/base/error.h>
#include <supple/base/gather.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace Supple
{
  using namespace dealii;

  namespace
  {
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
    : surface(body)
    , communicator(body.mesh.communicator)
    , file(folder + "/" + file_name())
    , fields(names_of_fields(with_contact, with_errors))
    , magic("supple frames of" + joined(fields) + "\n")
    , root(Utilities::MPI::this_mpi_process(body.mesh.communicator) == 0)
  {
  }


  std::string
  Film::file_name()
  {
    return "report.frames";
  }


  std::size_t
  Film::head_size() const
  {
    return magic.size() + sizeof(std::uint64_t);
  }


  std::size_t
  Film::frame_size() const
  {
    return 2 * sizeof(double) +
           (surface.rest.size() + fields.size() * surface.triangles.size()) * sizeof(float);
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
    values.reserve(surface.own_triangles.size());
    if (name == of_contact)
      {
        const GhostValues pressure(*drawing.contact_pressure);
        for (const auto &[nodes, cell_index, material] : surface.own_triangles)
          values.push_back((pressure.data()[3 * nodes[0]] + pressure.data()[3 * nodes[1]] +
                            pressure.data()[3 * nodes[2]]) /
                           3.);
        return values;
      }
    const std::vector<float> *of_cells = drawing.error_in_space;
    for (const auto &[name_of_cells, values_of_cells] : drawing.cells.named())
      if (name == name_of_cells)
        of_cells = values_of_cells;
    for (const BodySurface::Triangle &triangle : surface.own_triangles)
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
          gathered_on_first(own_values(fields[f], drawing), communicator);
        all.resize(all.size() + surface.triangle_place.size());
        for (std::size_t i = 0; i < surface.triangle_place.size(); ++i)
          all[f * surface.triangle_place.size() + surface.triangle_place[i]] = here[i];
      }
    return all;
  }


  void
  Film::write(const Drawing &drawing)
  {
    std::vector<float> values       = surface.gathered(drawing.displacement);
    const std::vector<float> fields = gather_fields(drawing);
    if (!root)
      return;

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
    frame.displacement.resize(surface.rest.size());
    frame.cells.resize(fields.size() * surface.triangles.size());
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
    PackedFilm packed(surface.rest, surface.triangles, surface.materials, fields);
    packed.n_written        = n_frames;
    const std::size_t begin = packed.bytes.size();
    const std::size_t room  = limit > begin ? limit - begin : 0;
    const std::size_t size =
      (surface.rest.size() + fields.size() * surface.triangles.size()) * sizeof(std::uint16_t);
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
