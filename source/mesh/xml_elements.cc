#include <supple/mesh/xml_elements.h>

#include <supple/base/error.h>

#include <algorithm>
#include <limits>
#include <memory>

#include <expat.h>

namespace Supple
{
  namespace
  {
    constexpr std::size_t deepest = 50;


    /** What Expat calls while it reads a text. */
    struct Tree
    {
      XmlElement outside;                          ///< its child is the outermost element
      std::vector<XmlElement *> open = {&outside}; ///< in which the next text stands
      XML_Parser parser;
      bool too_deep = false;

      static void
      begin(void *const data, const char *const name, const char **attribute)
      {
        Tree &tree = *static_cast<Tree *>(data);
        if (tree.open.size() > deepest)
          {
            tree.too_deep = true;
            XML_StopParser(tree.parser, XML_FALSE);
            return;
          }
        // Only the last child of an element is open: the others may move.
        XmlElement &element = tree.open.back()->children.emplace_back();
        element.name        = name;
        for (; *attribute; attribute += 2)
          element.attributes[attribute[0]] = attribute[1];
        tree.open.push_back(&element);
      }

      static void
      end(void *const data, const char * /* name */)
      {
        static_cast<Tree *>(data)->open.pop_back();
      }

      static void
      add_text(void *const data, const char *const text, const int length)
      {
        static_cast<Tree *>(data)->open.back()->text.append(text, length);
      }
    };
  } // namespace


  std::string
  XmlElement::attribute(const std::string &of) const
  {
    const auto found = attributes.find(of);
    return found == attributes.end() ? "" : found->second;
  }


  const XmlElement *
  XmlElement::child(const std::string &of) const
  {
    const auto found = std::find_if(children.begin(), children.end(), [&](const XmlElement &one) {
      return one.name == of;
    });
    return found == children.end() ? nullptr : &*found;
  }


  XmlElement
  parse_xml(const std::string &text)
  {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), XML_ParserFree);
    Tree tree;
    tree.parser = parser.get();
    XML_SetUserData(parser.get(), &tree);
    XML_SetElementHandler(parser.get(), Tree::begin, Tree::end);
    XML_SetCharacterDataHandler(parser.get(), Tree::add_text);

    const std::size_t most_at_once = std::numeric_limits<int>::max();
    for (std::size_t begin = 0; begin <= text.size(); begin += most_at_once)
      {
        const std::size_t n = std::min(most_at_once, text.size() - begin);
        const bool last     = begin + n == text.size();
        if (XML_Parse(parser.get(), text.data() + begin, static_cast<int>(n), last) ==
            XML_STATUS_OK)
          {
            if (last)
              break;
            continue;
          }
        const auto line = std::to_string(XML_GetCurrentLineNumber(parser.get()));
        throw InputError("line " + line + ": " +
                         (tree.too_deep ? "elements lie too deep in each other"
                                        : XML_ErrorString(XML_GetErrorCode(parser.get()))) +
                         ".");
      }
    return std::move(tree.outside.children.front());
  }
} // namespace Supple
