#ifndef supple_live_server_h
#define supple_live_server_h

#include <supple/live/mailbox.h>

#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** What the server gives to whoever has the token. */
  struct LiveContent
  {
    std::string page;    ///< HTML
    std::string surface; ///< octets
  };


  /**
   * Serves one page on 127.0.0.1, and carries its requests and what the simulation answers over one
   * WebSocket, in a thread of its own.
   *
   * Nobody gets anything without the token in the address, which is drawn at random for each
   * session. Requests for another host (whose name might be bound to this address) and sockets
   * opened by pages of another origin are refused, as is a second page while one is there.
   */
  class LiveServer
  {
  public:
    /** @throws InputError if no port can be had */
    LiveServer(Mailbox &mailbox, LiveContent content);

    /** Closes the socket after what waits to be sent. */
    ~LiveServer();

    LiveServer(const LiveServer &) = delete;
    LiveServer &
    operator=(const LiveServer &) = delete;

    /** Of the page, with its token. */
    std::string
    address() const;

  private:
    class Thread;

    std::unique_ptr<Thread> thread;
  };
} // namespace Supple

#endif
