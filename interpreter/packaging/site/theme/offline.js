// Search in pages that are opened as files: there, a browser lets a page neither fetch nor start a worker. So the index is
// a script (build.sh makes it), and what the theme starts as a worker runs in a hidden frame.
if (location.protocol === "file:") {
  const folder = document.currentScript.src;
  const index = new Promise((resolve) => {
    window.takeSearchIndex = resolve;
  });
  const script = document.createElement("script");
  script.src = new URL("search/search_index.js", folder);
  document.head.append(script);
  window.__search = { index };

  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      this.ready = new Promise((resolve) => {
        frame.addEventListener("load", () => this.run(url, frame.contentWindow, resolve), { once: true });
      });
      document.documentElement.append(frame);
    }

    run(url, room, done) {
      room.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      const code = room.document.createElement("script");
      code.src = url;
      code.addEventListener("load", () => done(room));
      room.document.head.append(code);
    }

    postMessage(data) {
      this.ready.then((room) => room.dispatchEvent(new MessageEvent("message", { data })));
    }
  };
}
