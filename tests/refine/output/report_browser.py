#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a report in headless Chromium and uses it: report_browser.py REPORT LAMP, LAMP being the id of a lamp in it.

Exit code 0: all is well; 1: what is not is said; 77: there is no browser to try it with.
"""
import base64
import pathlib
import shutil
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from webdriver import Browser  # noqa: E402

SHIFT, RIGHT, HOME, END, TAB = "\ue008", "\ue014", "\ue011", "\ue010", "\ue004"
PIXELS = """
const decoded = async (text) => {
  const image = new Image();
  image.src = 'data:image/png;base64,' + text;
  await image.decode();
  const pad = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  [pad.canvas.width, pad.canvas.height] = [image.width, image.height];
  pad.drawImage(image, 0, 0);
  return pad.getImageData(0, 0, image.width, image.height);
};
const halves = ({width, height}, of) => [0, 1].map((right) => {
  let sum = 0, count = 0;
  for (let y = 0; y < height; ++y)
    for (let x = Math.floor(right * width / 2) + 2 * right; x < (right + 1) * width / 2 - 2; ++x, ++count)
      sum += of(4 * (y * width + x));
  return sum / count;
});
"""
failures = []


def expect(good, what):
    if not good:
        failures.append(what)
        print(f"report: {what}")


def settle(browser):
    """Waits until what was asked for has been drawn."""
    browser.run("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")
    time.sleep(0.1)


def shot(browser, selector):
    settle(browser)
    return base64.b64encode(browser.screenshot(selector)).decode()


def brightness(browser, png):
    """Mean of the green channel in the left and the right half, 0 to 255."""
    return browser.run(PIXELS + "return decoded(arguments[0]).then((a) => halves(a, (k) => a.data[k + 1]))", png)


def difference(browser, one, other):
    """Mean absolute difference of the two halves."""
    return browser.run(PIXELS + "return Promise.all([...arguments].map(decoded)).then(([a, b]) =>"
                       "halves(a, (k) => Math.abs(a.data[k + 1] - b.data[k + 1])))", one, other)


def focus(browser, selector):
    browser.run("document.querySelector(arguments[0]).focus()", selector)


def set_control(browser, selector, value):
    browser.run("const c = document.querySelector(arguments[0]); c.value = arguments[1];"
                "c.dispatchEvent(new Event(c.type === 'range' ? 'input' : 'change', {bubbles: true}))", selector, value)


def check_console(browser, where):
    for entry in browser.log():
        expect(entry["level"] != "SEVERE", f"{where}: the console says: {entry['message']}")


def check_page(browser, lamp):
    expect(browser.run("return window.alert.name === 'alert' && !window.hostile"), "a text of the stack was run")
    expect(lamp in browser.run("return document.getElementById('frames').textContent"), "the lamp's id is not shown")
    expect(browser.run("return [...document.images].every((i) => i.alt && i.naturalWidth)"),
           "a picture is broken or has no alt text")
    expect(browser.run("return [...document.querySelectorAll('input,select')].every((c) => c.labels.length || c.ariaLabel)"),
           "a control has no label")
    expect(browser.run("return performance.getEntriesByType('resource').every((r) => r.name.startsWith('data:'))"),
           "the page loads something")
    expect(browser.run("return document.querySelectorAll('svg[role=img][aria-label]').length") >= 4,
           "a diagram is missing")
    expect(browser.run("return document.documentElement.scrollWidth <= innerWidth"), "the page is wider than the window")


def check_focus_order(browser):
    browser.run("document.activeElement.blur()")
    order = []
    for _ in range(14):
        browser.keys(TAB)
        order.append(browser.run("return document.activeElement.id || document.activeElement.className"))
    expected = ["skip", "compare-what", "compare", "surface-of", "material", "azimuth", "elevation", "reset", "canvas"]
    expect([name for name in order if name in expected] == expected, f"the focus goes {order}")


def check_compare(browser):
    focus(browser, "#compare")
    browser.keys(HOME)
    refined = shot(browser, ".stage")
    browser.keys(END)
    sensor = shot(browser, ".stage")
    expect(min(difference(browser, refined, sensor)) > 1, "the ends of the slider look alike")
    browser.keys(HOME, *[RIGHT] * 50)
    middle = shot(browser, ".stage")
    left, right = difference(browser, middle, sensor)
    expect(left < 0.5 < right, f"half-way the left is not the sensor's: {left}, {right}")
    left, right = difference(browser, middle, refined)
    expect(right < 0.5 < left, f"half-way the right is not the refined: {left}, {right}")
    browser.drag(".stage", (0.5, 0.5), (0.9, 0.5))
    expect(int(browser.run("return document.getElementById('compare').value")) > 80, "the mouse does not move the divider")


def check_surface(browser):
    expect(browser.run("return document.getElementById('no-webgl').hidden"), "there is no WebGL")
    set_control(browser, "#elevation", 15)
    set_control(browser, "#azimuth", 180)
    from_left = shot(browser, "#canvas")
    left, right = brightness(browser, from_left)
    expect(left > right + 2, f"a lamp at the left does not light the left more: {left}, {right}")
    set_control(browser, "#azimuth", 0)
    left, right = brightness(browser, shot(browser, "#canvas"))
    expect(right > left + 2, f"a lamp at the right does not light the right more: {left}, {right}")
    browser.run("document.querySelector('input[name=drag][value=light]').click()")
    browser.drag("#canvas", (0.6, 0.5), (0.15, 0.5))
    dragged = shot(browser, "#canvas")
    left, right = brightness(browser, dragged)
    expect(left > right + 2, f"the light does not follow the mouse: {left}, {right}")
    browser.run("document.querySelector('input[name=drag][value=turn]').click()")
    browser.drag("#canvas", (0.4, 0.5), (0.6, 0.6))
    turned = shot(browser, "#canvas")
    expect(max(difference(browser, dragged, turned)) > 2, "dragging does not turn the surface")
    focus(browser, "#canvas")
    browser.keys(HOME)
    expect(max(difference(browser, dragged, shot(browser, "#canvas"))) < 0.01, "Home does not show the front again")
    browser.keys(RIGHT)
    expect(max(difference(browser, dragged, shot(browser, "#canvas"))) > 0.5, "arrow keys do not turn")
    browser.keys(HOME)
    set_control(browser, "#surface-of", "sensor")
    expect(max(difference(browser, dragged, shot(browser, "#canvas"))) > 0.5, "the sensor's surface looks the same")
    for material in range(1, 5):
        before = shot(browser, "#canvas")
        set_control(browser, "#material", str(material))
        expect(max(difference(browser, before, shot(browser, "#canvas"))) > 0.5, f"material {material} changes nothing")


def check_dark(browser):
    paper = "return getComputedStyle(document.body).backgroundColor"
    colors = []
    for scheme in ("light", "dark"):
        browser.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        colors.append(browser.run(paper))
    expect(colors[0] == "rgb(255, 255, 255)" and colors[1] != colors[0], f"light and dark paper are {colors}")


def main(report, lamp):
    with Browser() as browser:
        browser.open(report)
        settle(browser)
        check_page(browser, lamp)
        check_focus_order(browser)
        check_compare(browser)
        check_surface(browser)
        check_dark(browser)
        check_console(browser, "with WebGL")
        browser.command("Emulation.setDeviceMetricsOverride", width=360, height=700, deviceScaleFactor=1, mobile=False)
        expect(browser.run("return document.documentElement.scrollWidth <= innerWidth"), "a narrow page is too wide")
    with Browser(flags=["--disable-3d-apis"]) as browser:
        browser.open(report)
        settle(browser)
        expect(browser.run("return !document.getElementById('no-webgl').hidden && document.getElementById('viewer').hidden"),
               "without WebGL nothing says so")
        check_console(browser, "without WebGL")
    return 1 if failures else 0


if __name__ == "__main__":
    for tool in ("chromium", "chromedriver"):
        if not shutil.which(tool):
            print(f"report: {tool} is missing, so the page is not tried")
            sys.exit(77)
    sys.exit(main(*sys.argv[1:]))
