#include <supple/mesh/xml_elements.h>

#include <supple/base/error.h>

#include <algorithm>
#include <cctype>

namespace Supple
{
  namespace
  {
    constexpr unsigned int deepest = 50;


    class Parser
    {
    public:
      explicit Parser(const std::string &text)
        : text(text)
      {
      }

      XmlElement
      document()
      {
        while (skip_to_element())
          if (text[position + 1] != '/')
            return element(0);
        throw InputError("there is no XML in it.");
      }

    private:
      const std::string &text;
      std::size_t position = 0;

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        const std::size_t end = std::min(position, text.size());
        const auto line       = 1 + std::count(text.begin(), text.begin() + end, '\n');
        throw InputError("line " + std::to_string(line) + ": " + why);
      }

      bool
      at(const std::string &what) const
      {
        return text.compare(position, what.size(), what) == 0;
      }

      void
      skip_past(const std::string &what)
      {
        const auto found = text.find(what, position);
        if (found == std::string::npos)
          refuse("the file ends before '" + what + "'.");
        position = found + what.size();
      }

      /** Beyond text, comments and declarations, to the next < of an element. */
      bool
      skip_to_element()
      {
        while ((position = text.find('<', position)) != std::string::npos)
          if (at("<!--"))
            skip_past("-->");
          else if (at("<?") || at("<!"))
            skip_past(">");
          else
            return position + 1 < text.size();
        return false;
      }

      void
      skip_blanks()
      {
        while (position < text.size() && std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
      }

      std::string
      word()
      {
        const auto end = std::min(text.find_first_of(" \t\r\n=/>\"'<", position), text.size());
        const std::string content = text.substr(position, end - position);
        position                  = end;
        return content;
      }

      static std::string
      without_entities(std::string content)
      {
        // The ampersand comes last: what it makes is no entity.
        for (const auto &[entity, character] : {std::make_pair("&lt;", "<"),
                                                {"&gt;", ">"},
                                                {"&quot;", "\""},
                                                {"&apos;", "'"},
                                                {"&amp;", "&"}})
          for (auto found = content.find(entity); found != std::string::npos;
               found      = content.find(entity, found + 1))
            content.replace(found, std::string(entity).size(), character);
        return content;
      }

      void
      read_attributes(XmlElement &element)
      {
        for (skip_blanks(); position < text.size() && text[position] != '>' && !at("/>");
             skip_blanks())
          {
            const std::string name = word();
            skip_blanks();
            if (name.empty() || !at("="))
              refuse("the attributes of <" + element.name + "> are not whole.");
            ++position;
            skip_blanks();
            const char quote = position < text.size() ? text[position] : ' ';
            const auto end   = text.find(quote, position + 1);
            if ((quote != '"' && quote != '\'') || end == std::string::npos)
              refuse("the attribute " + name + " is not in quotes.");
            element.attributes[name] =
              without_entities(text.substr(position + 1, end - position - 1));
            position = end + 1;
          }
      }

      XmlElement
      element(const unsigned int depth)
      {
        if (depth > deepest)
          refuse("elements lie too deep in each other.");
        ++position;
        XmlElement result;
        result.name = word();
        read_attributes(result);
        if (at("/>"))
          {
            position += 2;
            return result;
          }
        skip_past(">");
        for (std::size_t begin = position;; begin = position)
          {
            const bool found = skip_to_element();
            result.text += text.substr(begin, found ? position - begin : std::string::npos);
            if (!found)
              refuse("the file ends before </" + result.name + ">.");
            if (text[position + 1] != '/')
              {
                result.children.push_back(element(depth + 1));
                continue;
              }
            position += 2;
            const std::string end = word();
            if (end != result.name)
              refuse("</" + end + "> stands where <" + result.name + "> should end.");
            skip_past(">");
            return result;
          }
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
    return Parser(text).document();
  }
} // namespace Supple
