# SPDX-License-Identifier: MIT
"""A browser for the tests of pages: it opens a page beside a script, and what the script sends
comes back.

The script runs in a page that holds the page under test in a frame; it waits for what it needs and
calls `send(value)`. Nothing depends on how long the browser takes: a busy machine is waited for up
to SECONDS.
"""
import contextlib
import functools
import http.server
import json
import os
import queue
import shutil
import subprocess
import tempfile
import threading

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SECONDS = 300

BESIDE = """<!DOCTYPE html><iframe width="{width}" height="7900" src="{address}"></iframe><script>
"use strict";
const send = (value) => fetch("answer", {{ method: "POST", body: JSON.stringify(value) }});
onerror = (message) => {{ send({{ faults: [message] }}); }};
// Calls `then` with the page and its window as soon as `ready` holds of the page.
const when = (ready, then) => {{
  const frame = document.querySelector("iframe"), page = frame.contentDocument;
  if (page && page.readyState === "complete" && ready(page))
    then(page, frame.contentWindow);
  else
    setTimeout(when, 100, ready, then);
}};
{script}
</script>"""


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves a folder and, as `beside.html`, the page with the script; puts what is sent into
    `answers`.
    """

    def __init__(self, *args, beside, answers, **kwargs):
        self.beside, self.answers = beside, answers
        super().__init__(*args, **kwargs)

    def do_GET(self):
        if self.path != "/beside.html":
            super().do_GET()
            return
        self.send_response(200)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.end_headers()
        self.wfile.write(self.beside)

    def do_POST(self):
        self.answers.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, format, *args):
        """Nothing: the tests' output is for faults."""


@contextlib.contextmanager
def served(folder, beside, answers):
    """The address of a server of a folder."""
    handler = functools.partial(Handler, directory=folder, beside=beside, answers=answers)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()


def ask(folder, address, script, width=1300, seconds=SECONDS):
    """(what the script beside the page sends, the browser's messages); the address is relative to
    the folder.
    """
    beside = BESIDE.format(width=width, address=address, script=script).encode()
    answers = queue.Queue()
    with served(folder, beside, answers) as server, tempfile.TemporaryDirectory(
        ignore_cleanup_errors=True
    ) as profile:
        log = os.path.join(profile, "messages")
        command = [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--use-gl=angle",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--enable-logging=stderr",
            "--no-first-run",
            "--no-proxy-server",
            "--window-size=1400,8000",
            "--remote-debugging-port=0",
            f"--user-data-dir={profile}",
            f"{server}/beside.html",
        ]
        with open(log, "w", encoding="utf-8") as messages, subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=messages, start_new_session=True
        ) as browser:
            try:
                answer = answers.get(timeout=seconds)
            except queue.Empty:
                answer = None
            finally:
                browser.terminate()
        with open(log, encoding="utf-8", errors="replace") as messages:
            text = messages.read()
    if answer is None:
        raise AssertionError(
            f"the page did not answer within {seconds} s; the browser says:\n{text[-3000:]}"
        )
    return answer, text
