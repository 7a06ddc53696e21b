#include <supple/mesh/text_readers.h>

#include <supple/base/error.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace Supple
{
  namespace
  {
    /** What a keyword announces: so many rows of vertices and a reference. */
    struct Kind
    {
      std::string keyword;
      unsigned int dimension;
      unsigned int n_vertices;
      std::string other; ///< its name if it is none of our elements
    };

    const std::vector<Kind> kinds = {{"edges", 1, 2, ""},
                                     {"triangles", 2, 3, ""},
                                     {"tetrahedra", 3, 4, ""},
                                     {"edgesp2", 1, 3, "Line 3"},
                                     {"trianglesp2", 2, 6, "Triangle 6"},
                                     {"quadrilaterals", 2, 4, "Quadrilateral 4"},
                                     {"quadrilateralsq2", 2, 9, "Quadrilateral 9"},
                                     {"tetrahedrap2", 3, 10, "Tetrahedron 10"},
                                     {"hexahedra", 3, 8, "Hexahedron 8"},
                                     {"hexaedra", 3, 8, "Hexahedron 8"},
                                     {"hexahedraq2", 3, 27, "Hexahedron 27"},
                                     {"prisms", 3, 6, "Prism 6"},
                                     {"pentahedra", 3, 6, "Prism 6"},
                                     {"pyramids", 3, 5, "Pyramid 5"}};


    /** What other kinds of cells begin with, such as TetrahedraP3, and their dimensions. */
    const std::vector<std::pair<std::string, unsigned int>> stems = {{"tetrahedra", 3},
                                                                     {"hexahedra", 3},
                                                                     {"hexaedra", 3},
                                                                     {"prisms", 3},
                                                                     {"pentahedra", 3},
                                                                     {"pyramids", 3},
                                                                     {"polyhedra", 3},
                                                                     {"triangles", 2},
                                                                     {"quadrilaterals", 2},
                                                                     {"polygons", 2}};


    /** The words of a text; # begins a comment. */
    class Words
    {
    public:
      explicit Words(const std::string &file)
        : stream(file)
      {
        next();
      }

      /** The word that is next, in small letters; empty at the end. */
      std::string word;

      void
      next()
      {
        while (stream >> word && word[0] == '#')
          std::getline(stream, word);
        if (!stream)
          word.clear();
        std::transform(word.begin(), word.end(), word.begin(), [](const unsigned char letter) {
          return std::tolower(letter);
        });
      }

      bool
      is_keyword() const
      {
        return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0]));
      }

      /** @throws InputError if the next word is not a number */
      double
      number(const std::string &of)
      {
        char *end          = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (word.empty() || *end != '\0' || !std::isfinite(value))
          throw InputError(word.empty() ? "the file ends before all " + of + " are there."
                                        : "of the " + of + " a number is '" + word + "'.");
        next();
        return value;
      }

      std::size_t
      count(const std::string &of)
      {
        const double value = number(of);
        if (value < 0. || value != std::floor(value) || value > 1e12)
          throw InputError("there can't be " + std::to_string(value) + " " + of + ".");
        return value;
      }

      /** @throws InputError if a list goes on after what is announced */
      void
      require_end(const std::string &of, const std::size_t announced) const
      {
        if (!word.empty() && !is_keyword())
          throw InputError("there are more " + of + " than the " + std::to_string(announced) +
                           " that are announced.");
      }

      /** Goes to the next keyword. */
      void
      skip()
      {
        while (!word.empty() && !is_keyword())
          next();
      }

    private:
      std::ifstream stream;
    };


    void
    read_vertices(FileMesh &mesh, Words &words, const unsigned int dimension)
    {
      if (!mesh.vertices.empty())
        throw InputError("there are two sections of vertices.");
      const std::size_t n = words.count("vertices");
      for (std::size_t v = 1; v <= n; ++v)
        {
          dealii::Point<3> place;
          for (unsigned int d = 0; d < dimension; ++d)
            place[d] = words.number("vertices");
          words.number("vertices"); // a reference
          mesh.vertices.emplace_hint(mesh.vertices.end(), v, place);
        }
      words.require_end("vertices", n);
    }


    /** @return how many have a negative reference */
    std::size_t
    read_elements(FileMesh &mesh, Words &words, const Kind &kind)
    {
      const std::size_t n  = words.count(kind.keyword);
      const bool quadratic = kind.keyword == "trianglesp2" || kind.keyword == "tetrahedrap2";
      if (!kind.other.empty() && !quadratic && n > 0)
        mesh.others[kind.dimension][kind.other] += n;
      std::size_t n_negative = 0;
      for (std::size_t e = 1; e <= n; ++e)
        {
          FileMesh::Element element{e, {}, {}};
          std::vector<std::size_t> nodes;
          for (unsigned int v = 0; v < kind.n_vertices; ++v)
            {
              nodes.push_back(words.count(kind.keyword));
              if (v < element.vertices.size())
                element.vertices[v] = nodes[v];
            }
          const double reference = words.number(kind.keyword);
          if (reference > 0.)
            element.ids.push_back(id_of(reference));
          n_negative += reference < 0.;
          if (quadratic)
            add_quadratic(mesh, element, nodes, NodeOrder::vtk);
          else if (kind.other.empty())
            mesh.elements[kind.dimension].push_back(element);
        }
      words.require_end(kind.keyword, n);
      return n_negative;
    }


    /** A section of another name: cells of unknown kinds are counted, Corners or Normals are not of
     * interest. */
    void
    skip_section(FileMesh &mesh, Words &words, const std::string &keyword)
    {
      for (const auto &[stem, dimension] : stems)
        if (keyword.rfind(stem, 0) == 0)
          if (const std::size_t n = words.count(keyword); n > 0)
            mesh.others[dimension][keyword] += n;
      words.skip();
    }
  } // namespace


  FileMesh
  read_medit(const std::string &file)
  {
    FileMesh mesh;
    Words words(file);
    if (words.word != "meshversionformatted")
      throw InputError(
        "this is not a mesh of Medit: such a file begins with "
        "MeshVersionFormatted.");
    unsigned int dimension = 3;
    std::size_t n_negative = 0;
    while (!words.word.empty() && words.word != "end")
      {
        const std::string keyword = words.word;
        words.next();
        const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind &known) {
          return known.keyword == keyword;
        });
        if (keyword == "dimension")
          {
            dimension = words.count("dimensions");
            if (dimension != 2 && dimension != 3)
              throw InputError("its dimension is " + std::to_string(dimension) +
                               "; there should be 2 or 3.");
          }
        else if (keyword == "vertices")
          read_vertices(mesh, words, dimension);
        else if (kind != kinds.end())
          n_negative += read_elements(mesh, words, *kind);
        else
          skip_section(mesh, words, keyword);
      }
    if (n_negative > 0)
      mesh.warnings.push_back(std::to_string(n_negative) +
                              " element(s) have a negative reference; they get the id 0.");
    return mesh;
  }
} // namespace Supple
