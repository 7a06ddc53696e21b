#ifndef supple_text_readers_h
#define supple_text_readers_h

#include <supple/mesh/file_mesh.h>

namespace Supple
{
  /**
   * Nastran's bulk data (.bdf, .nas): GRID, CTETRA and CTRIA3, in fields of 8 or 16 characters or
   * set apart by commas, with continuation lines and INCLUDE. Properties are the ids.
   * @throws InputError for what is not whole or not understood, with its line
   */
  FileMesh
  read_nastran(const std::string &file);

  /**
   * Medit's text (.mesh). References are the ids.
   * @throws InputError where the file has not what it announces
   */
  FileMesh
  read_medit(const std::string &file);

  /**
   * I-DEAS universal files (.unv): datasets 2411 or 781, 2412, and groups of elements, whose
   * numbers are the ids. Elements of a dimension without groups have the material as the id, or the
   * physical property if that alone differs.
   * @throws InputError for what is not whole or not understood
   */
  FileMesh
  read_universal(const std::string &file);

  /**
   * Legacy VTK files with an unstructured grid, versions 1 to 5.1, ASCII or binary. Ids are those
   * of a field of cells with one of the names in doc/meshes.md.
   * @throws InputError for what is not whole or not understood
   */
  FileMesh
  read_legacy_vtk(const std::string &file);

  /**
   * VTK's XML files with an unstructured grid (.vtu), all its pieces, with arrays in text, in
   * base64 or appended, packed by zlib or not. Ids as in legacy files.
   * @throws InputError for what is not whole or not understood
   */
  FileMesh
  read_vtu(const std::string &file);
} // namespace Supple

#endif
