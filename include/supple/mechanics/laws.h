#ifndef supple_laws_h
#define supple_laws_h

#include <supple/mechanics/law.h>
#include <supple/mechanics/law_choice.h>
#include <supple/mechanics/rotation.h>

#include <memory>
#include <string>

namespace Supple
{
  /** The names of all laws as in Material/Law, separated by |. */
  std::string
  names_of_laws();


  /** The law of this name for these cells, which must outlive it. The name must be one of the list.
   * @param rotation of the corotational law; others have none */
  std::unique_ptr<Law>
  make_law(const LawChoice &choice, RotationMethod rotation, const Cells &cells);
} // namespace Supple

#endif
