"""Whoever has not the token, comes from elsewhere or talks nonsense gets a refusal, and the session goes on."""

import pathlib
import socket
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import live_client
import runner

SMALL = runner.ROOT / "parameters" / "bar" / "small.prm"


def status(answer):
    return int(answer.split()[1]) if answer.startswith("HTTP/1.1 ") else None


def refused(session, lines, wanted, word, what):
    answer = session.ask(lines)
    runner.check(status(answer) == wanted and word in answer, f"{what}: {answer[:300]}")


def closed(page, what):
    """The page is sent away, with a reason, or with the protocol's own codes for what is too long (1009) and no text (1007)."""
    try:
        while page.closed is None:
            page.receive()
    except (EOFError, OSError):
        pass
    page.connection.close()
    runner.check(page.closed is not None and (page.closed[1] != "" or page.closed[0] in (1007, 1009)), f"{what}: {page.closed}")
    return page.closed


def new_page(session):
    """When the one before has gone, another one is let in."""
    for _ in range(100):
        if session.ask(session.upgrade_lines()).startswith("HTTP/1.1 101"):
            break
    for _ in range(100):
        try:
            page = live_client.Page(session)
            page.until(lambda: page.texts, "the state")
            return page
        except SystemExit:
            continue
    return sys.exit("FAILED: no other page is let in")


with live_client.Session(SMALL, {}) as session:
    get = f"GET /?token={session.token} HTTP/1.1"
    host = f"Host: {session.host}"
    wrong = session.token[:-1] + ("0" if session.token[-1] != "0" else "1")
    runner.check(len(session.token) == 32, f"the token {session.token} is no 128 bits")
    page = session.ask([get, host])
    runner.check(status(page) == 200 and '"kind":"live"' in page.replace('": "', '":"') and "no-store" in page, "the page is not served")
    runner.check(session.host in page and "connect-src 'self'" in page and "SUPPLE_" not in page, "the page can't connect")

    refused(session, ["GET / HTTP/1.1", host], 403, "token", "no token")
    refused(session, [f"GET /?token={wrong} HTTP/1.1", host], 403, "token", "a wrong token")
    refused(session, [f"GET /?token={session.token}0 HTTP/1.1", host], 403, "token", "a longer token")
    refused(session, ["GET /surface HTTP/1.1", host], 403, "token", "the surface without a token")
    refused(session, [get, "Host: evil.example"], 403, "no other", "another host")
    refused(session, [get, f"Host: localhost:{session.port}"], 403, "no other", "another name of the host")
    refused(session, [get], 403, "no other", "no host")
    refused(session, [f"POST /?token={session.token} HTTP/1.1", host, "Content-Length: 0"], 405, "GET", "another method")
    refused(session, [f"GET /../etc/passwd?token={session.token} HTTP/1.1", host], 404, "no such page", "a file")
    refused(session, [f"GET /live.prm?token={session.token} HTTP/1.1", host], 404, "no such page", "a file of the results")
    refused(session, session.upgrade_lines(token=wrong), 403, "token", "a socket with a wrong token")
    refused(session, session.upgrade_lines(origin="http://evil.example"), 403, "page of this session", "a socket of another page")
    refused(session, session.upgrade_lines(origin=""), 403, "page of this session", "a socket of no page")
    refused(session, session.upgrade_lines(host="evil.example"), 403, "no other", "a socket by another host")
    for junk in (b"\0" * 5000, b"GET " + b"/" * 20000 + b" HTTP/1.1\r\n\r\n", b"\x16\x03\x01\x02\0\x01", b"GET / HTTP/1.1\r\nHost"):
        with session.connect() as connection:
            try:
                connection.sendall(junk)
                connection.shutdown(socket.SHUT_WR)
                connection.recv(1 << 16)
            except OSError: # it was closed at once
                pass
    half = session.connect()  # which never says a word
    try:
        with socket.create_connection((socket.gethostbyname(socket.gethostname()), session.port), timeout=3):
            runner.check(socket.gethostbyname(socket.gethostname()).startswith("127."), "another address than loopback is served")
    except OSError:
        pass

    page = live_client.Page(session)
    page.until(lambda: page.texts, "the state")
    refused(session, session.upgrade_lines(), 403, "Another page", "a second page")
    runner.check(status(session.ask([f"GET /surface?token={session.token} HTTP/1.1", host])) == 200, "the surface while a page is there")

    # What a page may not say is answered, and nothing changes.
    for command, word in [("set Mesh/Box cubes=9, 9, 9", "can't set Mesh/Box cubes"), ("set Output/Folder=/tmp", "can't set Output/Folder"),
                          ("set Material/Young modulus=-1", "greater than 0"), ("set Material/Yuong modulus=1", "Young modulus"),
                          ("set Nothing", "Section/Entry=value"), ("fly 1 2 3", "no such command"), ("grab 1.5 0 0 0 0 0", "whole number"),
                          ("grab 99999 0 0 0 0 0", "99999"), ("grab 28 0 0", "coordinate"), ("grab 28 0 nan 0 0 0", "finite"),
                          ("grab 28 2 0 2 -1 0", "below 0"), ("grab 80 0 12 0 0 0", "held"), ("hold 80 0 12 0", "held"),
                          ("move 28 0 0 0", "no hand"), ("release 28", "no hand"), ("tool needle 0 0 0", "no tool needle"),
                          ("speed -1", "speed"), ("speed x", "finite"), ("take needle 0 0 0", "no such command"), ("again", "nothing has happened"),
                          ("set Loads/Gravity=1, 2", "Gravity"), ("set Loads/Body force=x; y", "3")]:
        page.do(command)
        message = page.answer("refused")
        runner.check(message["number"] == page.number and word in message["message"], f"{command}: {message}")
    page.do("step")
    page.until(lambda: page.step() == 1, "a step after the refusals")

    # What is no message of the protocol closes the socket, and the next page finds the session.
    for message, kind, what in [("x" * 5000, 1, "5 kB"), (b"\1\2\3", 2, "octets"), ("no number", 1, "no number"), ("1", 1, "a number alone"),
                                ("-1 run", 1, "a negative number"), ("1 run\n2 quit", 1, "two lines"), (b"\xff\xfe", 1, "no text")]:
        page.send(message, kind)
        code, reason = closed(page, what)
        page = new_page(session)
        runner.check(page.texts[0]["kind"] == "state" and page.texts[0]["step"] == 1, f"after {what} the state is {page.texts[0]}")
    half.close()
    page.quit()
    runner.check(session.end() == 0, f"the session ends with {session.end()}")

for arguments, word in [(["--live"], "A scene is missing"), (["--live", runner.ROOT / "parameters" / "bar" / "static.prm"], "static"),
                        (["--live", runner.ROOT / "parameters" / "studies" / "bar-small.prm"], "single scene"),
                        (["--live", SMALL, "--set", "Checkpoint/Minutes=1"], "Checkpoint/Every")]:
    runner.refused(runner.run(*arguments, "--quiet"), [word], f"{arguments}")
