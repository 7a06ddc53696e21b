#ifndef supple_vtu_arrays_h
#define supple_vtu_arrays_h

#include <supple/mesh/xml_elements.h>

namespace Supple
{
  /** The numbers in the arrays of one of VTK's XML files. */
  class VtuArrays
  {
  public:
    /**
     * @param file the element VTKFile, which says how numbers are written and packed
     * @param appended all after the underscore of AppendedData
     * @param is_base64 whether that is in base64 and not raw
     * @throws InputError if they are packed in a way that is not read
     */
    VtuArrays(const XmlElement &file, std::string appended, bool is_base64);

    /** Of a DataArray, in whichever format.
     * @throws InputError where it is not whole, or of a type that is not read */
    std::vector<double>
    values(const XmlElement &array) const;

  private:
    std::string appended;
    bool is_base64, swapped, packed, wide_header;
  };
} // namespace Supple

#endif
