#ifndef supple_layer_pair_h
#define supple_layer_pair_h

namespace Supple
{
  /** Thickness of the upper layer [m], and its Young modulus over that of the lower one. */
  struct LayerPair
  {
    double thickness;
    double ratio;
  };
} // namespace Supple

#endif
