# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser without a display: the few WebDriver commands that the tests of report.html need."""
import base64
import json
import os
import pathlib
import re
import subprocess
import tempfile
import urllib.request

_FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--hide-scrollbars"]


class Browser:
    """Chromium with an empty profile, by chromedriver. Use as a context."""

    def __init__(self, width=1200, height=900, flags=(), environment=None):
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self._driver = subprocess.Popen(
            ["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            env={**os.environ, "HOME": self._profile.name, **(environment or {})})
        self._session = None
        try:
            for line in self._driver.stdout:
                if port := re.search(r"started successfully on port (\d+)", line):
                    break
            self._url = f"http://127.0.0.1:{port[1]}/session"
            arguments = [*_FLAGS, f"--user-data-dir={self._profile.name}/profile", f"--window-size={width},{height}", *flags]
            answer = self._send("POST", "", {"capabilities": {"alwaysMatch": {
                "goog:chromeOptions": {"args": arguments}, "goog:loggingPrefs": {"browser": "ALL"}}}})
            self._session = answer["sessionId"]
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        if self._session:
            self._send("DELETE", "")
        self._driver.terminate()
        self._driver.wait()
        self._driver.stdout.close()
        self._profile.cleanup()

    def _send(self, method, path, body=None):
        session = f"/{self._session}" if self._session else ""
        data = None if method != "POST" else json.dumps(body or {}).encode()
        request = urllib.request.Request(self._url + session + path, data, method=method,
                                         headers={"Content-Type": "application/json"})
        direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with direct.open(request, timeout=120) as answer:
            return json.load(answer)["value"]

    def open(self, file):
        self._send("POST", "/url", {"url": pathlib.Path(file).resolve().as_uri()})

    def run(self, script, *arguments):
        """The value of a script's `return`; of a promise, what it resolves to."""
        return self._send("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def log(self):
        """What the console got since the last call: entries with level and message."""
        return self._send("POST", "/se/log", {"type": "browser"})

    def command(self, name, **parameters):
        """A command of the DevTools protocol."""
        return self._send("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def screenshot(self, selector=None):
        """PNG bytes of the window, or of one element, scrolled to."""
        if not selector:
            return base64.b64decode(self._send("GET", "/screenshot"))
        found = self._send("POST", "/element", {"using": "css selector", "value": selector})
        return base64.b64decode(self._send("GET", f"/element/{next(iter(found.values()))}/screenshot"))

    def keys(self, *keys):
        """Presses and releases keys, one after the other, in whatever has the focus."""
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        self._send("POST", "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def drag(self, selector, start, end, button=0):
        """Drags with the mouse inside an element; places are shares of its width and height."""
        box = self.run("const e = document.querySelector(arguments[0]); e.scrollIntoView({block: 'center'});"
                       "const b = e.getBoundingClientRect(); return [b.left, b.top, b.width, b.height]", selector)
        at = [{"x": round(box[0] + x * box[2]), "y": round(box[1] + y * box[3])} for x, y in (start, end)]
        self._send("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [
            {"type": "pointerMove", **at[0]}, {"type": "pointerDown", "button": button},
            {"type": "pointerMove", "duration": 100, **at[1]}, {"type": "pointerUp", "button": button}]}]})
