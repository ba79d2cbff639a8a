// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Controls the camera with the mouse (drag, wheel, click) or one finger.

const CLICK_PIXELS = 4; // a press that moves fewer pixels is a click
const LINE_PIXELS = 16; // pixels per line, for wheels that report lines

// `on` has the callbacks moved(), click(px, py) with a position in pixels of the canvas, and grabbed(), which
// is called at each step of a pan.
export function controlCamera(canvas, camera, on) {
  let press = null;
  const positionOf = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    const at = positionOf(event);
    press = { at, from: at, pans: event.button !== 0 || event.shiftKey, far: false };
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!press) return;
    const at = positionOf(event);
    press.far ||= Math.hypot(at[0] - press.from[0], at[1] - press.from[1]) >= CLICK_PIXELS;
    if (!press.far) return;
    const [dx, dy] = [at[0] - press.at[0], at[1] - press.at[1]];
    press.at = at;
    if (press.pans) {
      camera.pan(dx, dy);
      on.grabbed();
    } else {
      camera.orbit(dx, dy);
    }
    on.moved();
  });
  canvas.addEventListener("pointerup", (event) => {
    if (press && !press.far && event.button === 0) on.click(...positionOf(event));
    press = null;
  });
  canvas.addEventListener("pointercancel", () => (press = null));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const turned = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PIXELS * event.deltaY : event.deltaY;
    camera.zoom(Math.exp(Math.min(300, Math.max(-300, turned)) * 0.0015), ...positionOf(event));
    on.moved();
  }, { passive: false });
}
