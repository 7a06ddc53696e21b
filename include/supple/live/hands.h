#ifndef supple_hands_h
#define supple_hands_h

#include <supple/input/parameter_file.h>
#include <supple/scene/parameters.h>

#include <map>
#include <string>
#include <vector>

namespace Supple
{
  class Words;


  /**
   * What hands hold and have changed in a live session, as deeds tell:
   *
   *   grab V x y z by W k ox oy oz, ...   springs of k [N/m] pull each vertex W to the hand of
   *                                       vertex V, which is at (x, y, z) [m], plus an offset o [m]
   *   hold V x y z                        vertex V is where its hand is, which is at (x, y, z)
   *   move V x y z over S                 its hand goes straight there within S [s]
   *   release V                           it lets go
   *   take NAME x y z                     a hand takes the tool, whose reference point is there
   *   tool NAME x y z over S              and moves it
   *   set Section/Entry=value             an entry of the scene is another one from here on
   *   renew                               all is made anew from the present state
   *   wait                                nothing: the session has come so far
   *
   * Vertices are told by their index in the mesh before partitioning.
   */
  class Hands
  {
  public:
    /** A copy has hands of its own. */
    Hands() = default;
    Hands(const Hands &other);
    Hands &
    operator=(const Hands &other);

    /** Exchanges the hands themselves. */
    void
    swap(Hands &other);

    enum class Effect
    {
      moves,   ///< hands alone
      changes, ///< the equations: another Simulation must go on
    };

    /** Does a deed at a time [s]. @throws InputError if there is no such deed, or it can't be done
     */
    Effect
    apply(const std::string &text, double time);

    /** What has been set so far, to be read on top of the scene. */
    std::vector<Override>
    overrides() const;

    /** Puts the hands into a scene; they stay these. */
    void
    put_into(Parameters &scene) const;

    bool
    grabs(unsigned int vertex) const
    {
      return grabbed.count(vertex) > 0;
    }

    bool
    holds(unsigned int vertex) const
    {
      return held.count(vertex) > 0;
    }

    bool
    has_taken(const std::string &tool) const
    {
      return tools.count(tool) > 0;
    }

    struct Grab
    {
      std::vector<Pull::End> ends;
      std::shared_ptr<HandPath> path;
    };

    const std::map<unsigned int, Grab> &
    grabs() const
    {
      return grabbed;
    }

    const std::map<unsigned int, std::shared_ptr<HandPath>> &
    holds() const
    {
      return held;
    }

  private:
    // The deeds. @throws InputError
    void
    grab(Words &words, double time);
    void
    hold(Words &words, double time);
    void
    move(Words &words, double time);
    void
    release(Words &words, double time);
    void
    take(Words &words, double time);
    void
    move_tool(Words &words, double time);
    void
    set_entry(Words &words, double time);
    void
    nothing(Words &words, double time);

    /** The next word, a vertex that no hand has. */
    unsigned int
    free_vertex(Words &words) const;

    static void
    move_path(HandPath &path, Words &words, double time);

    std::map<unsigned int, Grab> grabbed;
    std::map<unsigned int, std::shared_ptr<HandPath>> held;
    std::map<std::string, std::shared_ptr<HandPath>> tools;
    std::map<std::string, std::string> set; ///< entry -> value
  };


  /** Whether a live session may set an entry ("Section/Entry"): whatever leaves the mesh, what is
   * held by the scene and what is written as they are. */
  bool
  may_be_set(const std::string &entry);
} // namespace Supple

#endif
