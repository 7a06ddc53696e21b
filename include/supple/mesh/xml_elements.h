#ifndef supple_xml_elements_h
#define supple_xml_elements_h

#include <map>
#include <string>
#include <vector>

namespace Supple
{
  /** An element of an XML text: its tag's name and attributes, and what stands in it. */
  struct XmlElement
  {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string text;                 ///< what stands directly in it
    std::vector<XmlElement> children; ///< in their order

    /** Empty if there is none. */
    std::string
    attribute(const std::string &of) const;

    /** The first of this name, or null. */
    const XmlElement *
    child(const std::string &of) const;
  };


  /**
   * Reads a text by Expat.
   * @return the outermost element
   * @throws InputError with the line where it is no XML, or elements lie 50 deep in each other
   */
  XmlElement
  parse_xml(const std::string &text);
} // namespace Supple

#endif
