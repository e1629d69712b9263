// The screen around the face: it stays awake, gets filled, and hides what nobody uses.

const IDLE_MS = 3000;

/** Keep the screen from going dark, as long as somebody can see this page. */
export function keepAwake() {
  const ask = async () => {
    if (document.hidden) return;
    try {
      await navigator.wakeLock?.request("screen");
    } catch {
      // A battery that is nearly empty, or a browser that has no such thing: the screen does as it always does.
    }
  };
  // The browser lets go of it when the page is hidden.
  document.addEventListener("visibilitychange", ask);
  void ask();
}

/** Fill the screen, or give it back. */
export async function toggleFullscreen() {
  try {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await document.documentElement.requestFullscreen({ navigationUI: "hide" });
  } catch {
    // Telephones of some makers fill the screen with films only.
  }
}

/** Mark the page as idle when nobody moves anything: buttons and pointer fade. */
export function hideWhenIdle() {
  let timer = 0;
  const stir = () => {
    document.body.classList.remove("idle");
    window.clearTimeout(timer);
    timer = window.setTimeout(() => document.body.classList.add("idle"), IDLE_MS);
  };
  for (const kind of ["pointermove", "pointerdown", "keydown", "focusin"]) window.addEventListener(kind, stir);
  stir();
}
