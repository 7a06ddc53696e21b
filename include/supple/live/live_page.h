#ifndef supple_live_page_h
#define supple_live_page_h

#include <supple/contact/tool.h>
#include <supple/live/live_server.h>
#include <supple/live/session.h>
#include <supple/output/body_surface.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace Supple
{
  /** What the page of a session is made of, on the first process; collective. */
  LiveContent
  live_content(const Session &session, const BodySurface &surface);


  /** The entries that a session of this scene may set. */
  std::vector<std::string>
  names_of_entries(const Parameters &scene);


  /** The values of those that the page shows, by their names. */
  nlohmann::ordered_json
  values_of_entries(const std::vector<std::string> &names, const Parameters &scene);


  /** A frame: what the page needs to draw the body, as source/report/live_socket.js reads it. */
  struct LiveFrame
  {
    double time               = 0.; ///< [s]
    unsigned int step         = 0;
    unsigned int last_request = 0;
    double factor             = 0.; ///< simulated seconds a second
    bool running              = false;
    bool late                 = false;
    double steps_per_second   = 0.;
    double seconds_per_step   = 0.; ///< [s]
    unsigned int session      = 1;
    std::vector<Pose> tools;
    std::vector<float> displacements; ///< [m]
  };


  /** Little endian, with 16 bits for each number of a displacement. */
  std::vector<unsigned char>
  packed(const LiveFrame &frame);


  /** The scene that repeats a session from its folder, as the text of a file there. */
  std::string
  repeating_scene(const Parameters &first, const Session::Scene &scene, const std::string &folder);
} // namespace Supple

#endif
