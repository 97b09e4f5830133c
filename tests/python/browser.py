# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium that shows pages from disk, with its network cut."""

import io
import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flexact
from flexact.show.page import page

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
DRIVER = shutil.which("chromedriver")

#: Software drawing, no network but this machine: names do not resolve, and no proxy answers.
OPTIONS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
    "--proxy-server=127.0.0.1:9",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
    "--force-device-scale-factor=1",
)
_DRAWN = """
    const done = arguments[0];
    requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(() => done())));
"""


def _paged(model: Any) -> tuple[flexact.Analysis, str]:
    analysis = flexact.analyse(model)
    return analysis, page(analysis)


@cache
def paged(deck: Path) -> tuple[flexact.Analysis, str]:
    """The result of a deck and its page, made once for all tests."""
    return _paged(deck)


class Browser:
    """A page in the browser, and what is asked of it."""

    def __init__(self, driver: Any) -> None:
        self.driver = driver

    def open(self, path: Path) -> None:
        """Load a page from disk; what was logged before is forgotten."""
        self.driver.get("about:blank")
        self.console()
        self.requests()
        self.driver.get(path.as_uri())
        self.opened()

    def opened(self) -> None:
        """Wait until the page has opened what draws it, and drawn."""
        from selenium.webdriver.support.wait import WebDriverWait

        closed = "return document.querySelector('script.packed') !== null"
        WebDriverWait(self, 60).until(lambda b: not b.run(closed))
        self.drawn()

    def show(self, model: Any, folder: Path) -> flexact.Analysis:
        """Analyse a model or deck and open its page, at rest."""
        analysis, text = paged(model) if isinstance(model, Path) else _paged(model)
        target = folder / "page.html"
        target.write_text(text, encoding="utf-8")
        self.open(target)
        self.run("flexact.play(false)")
        self.drawn()
        return analysis

    def run(self, script: str, *arguments: Any) -> Any:
        """The value of a script."""
        return self.driver.execute_script(script, *arguments)

    def later(self, script: str, *arguments: Any) -> Any:
        """What a script hands to its last argument, a callback."""
        return self.driver.execute_async_script(script, *arguments)

    def drawn(self) -> None:
        """Wait until what was asked for has been drawn."""
        self.later(_DRAWN)

    def enter(self, frame: int) -> None:
        """Go into a frame, which may still load when the page around it has loaded."""
        from selenium.webdriver.support.wait import WebDriverWait

        self.driver.switch_to.frame(frame)
        WebDriverWait(self, 60).until(lambda b: b.run("return typeof flexact") == "object")
        self.drawn()

    def press(self, selector: str) -> None:
        """Click on an element, wherever it is."""
        self.run("document.querySelector(arguments[0]).click()", selector)
        self.drawn()

    def keys(self, *keys: str) -> None:
        """Press keys, as a person does, on what has the focus."""
        from selenium.webdriver import ActionChains

        ActionChains(self.driver).send_keys(*keys).perform()
        self.drawn()

    def point(self, x: int, y: int) -> None:
        """Move the pointer to a place of the canvas, from its upper left corner."""
        from selenium.webdriver import ActionChains
        from selenium.webdriver.common.by import By

        canvas = self.driver.find_element(By.CLASS_NAME, "canvas")
        size = canvas.size
        chain = ActionChains(self.driver)
        chain.move_to_element_with_offset(
            canvas, x - size["width"] // 2, y - size["height"] // 2
        ).perform()
        self.drawn()

    def console(self) -> list[str]:
        """Messages of the console since the last call."""
        return [f"{e['level']}: {e['message']}" for e in self.driver.get_log("browser")]

    def requests(self) -> list[str]:
        """Addresses that were asked for since the last call."""
        found = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
        return found

    def pixels(self, selector: str = ".stage") -> np.ndarray:
        """(height, width, 3) what a part of the page looks like."""
        from PIL import Image
        from selenium.webdriver.common.by import By

        element = self.driver.find_element(By.CSS_SELECTOR, selector)
        return np.asarray(Image.open(io.BytesIO(element.screenshot_as_png)).convert("RGB"))

    def resize(self, width: int, height: int) -> None:
        """Give the viewport a size, also one that is smaller than windows may be."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        self.drawn()

    def prefer(self, **features: str) -> None:
        """Set media features, such as prefers_color_scheme="dark"; none resets them."""
        chosen = [{"name": k.replace("_", "-"), "value": v} for k, v in features.items()]
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": chosen})


@contextmanager
def browsing(*more: str) -> Iterator[Browser]:
    """A browser; skips the test where there is none."""
    webdriver = pytest.importorskip("selenium.webdriver")
    pytest.importorskip("PIL")
    if CHROMIUM is None or DRIVER is None:
        pytest.skip("needs chromium and chromedriver (Debian: chromium, chromium-driver)")
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in (*OPTIONS, *more):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options, webdriver.ChromeService(DRIVER))
    try:
        driver.set_script_timeout(60)
        # As in a window at the front, whatever else the machine shows.
        driver.execute_cdp_cmd("Emulation.setFocusEmulationEnabled", {"enabled": True})
        yield Browser(driver)
    finally:
        driver.quit()


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """One browser for all tests."""
    with browsing() as browser:
        yield browser


@pytest.fixture
def browser(chromium: Browser) -> Iterator[Browser]:
    """The browser as it was at first, and nothing in it afterwards."""
    chromium.prefer()
    chromium.resize(1280, 900)
    yield chromium
    # A page that watches would go on asking for a server that has ended.
    driver = chromium.driver
    first, *others = driver.window_handles
    for other in others:
        driver.switch_to.window(other)
        driver.close()
    driver.switch_to.window(first)
    driver.get("about:blank")
    chromium.console()
