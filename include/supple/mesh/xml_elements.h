#ifndef supple_xml_elements_h
#define supple_xml_elements_h

#include <map>
#include <string>
#include <vector>

namespace Supple
{
  /** An element of an XML text, such as <DataArray type="Float64">1 2</DataArray>. */
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
   * Reads a text with comments, declarations and the five entities of XML.
   * @return the outermost element
   * @throws InputError where an element is not closed, or another one is
   */
  XmlElement
  parse_xml(const std::string &text);
} // namespace Supple

#endif
