import { useEffect, useState } from "preact/hooks";
import type { Looking, Store } from "../store/store";
import { Chart } from "./chart/chart";
import { Control } from "./control";
import { Header } from "./header";
import { globalKey } from "./keys";
import { Details } from "./panels/details";
import { Entries } from "./panels/entries";
import { Help } from "./panels/help";
import { Log } from "./panels/log";
import { Now } from "./panels/now";
import { Questions } from "./panels/questions";
import { onColorChange } from "./parts/colors";
import { Timeline } from "./timeline/timeline";
import { Tools } from "./tree/tools";
import { Tree } from "./tree/tree";

function useStore(store: Store): Looking {
  const [, redraw] = useState(0);
  useEffect(() => store.subscribe(() => redraw((count) => count + 1)), [store]);
  return store.looking;
}

function useWindow(store: Store) {
  const { theme } = store.looking;
  document.documentElement.dataset.theme = theme; // before anything asks for colors
  useEffect(() => {
    document.title = `${store.run.header?.tree ?? "run"} · lockstep`;
  }, [store.run.header]);
  useEffect(() => {
    const key = (event: KeyboardEvent) => globalKey(store, event);
    addEventListener("keydown", key);
    const stop = onColorChange(() => {
      ++store.colorVersion;
      store.changed();
    });
    return () => {
      removeEventListener("keydown", key);
      stop();
    };
  }, [store]);
}

function Empty({ store }: { store: Store }) {
  return (
    <main class="empty">
      <h1>lockstep</h1>
      <p role="status">{store.trouble || (store.live?.connection === "lost" ? "There is no connection." : "Reading the run …")}</p>
    </main>
  );
}

export function App({ store }: { store: Store }) {
  const looking = useStore(store);
  useWindow(store);
  if (store.run.header === null) return <Empty store={store} />;
  return (
    <>
      <Header store={store} />
      <Control store={store} />
      <Questions store={store} />
      {store.trouble && <p class="trouble" role="alert">{store.trouble}</p>}
      <main>
        <div class="left">
          <Tools store={store} looking={looking} />
          <Tree store={store} looking={looking} />
        </div>
        <aside aria-label="About this moment">
          <Now store={store} />
          <Details store={store} />
          <Chart store={store} />
          <Entries store={store} />
          <Log store={store} />
        </aside>
      </main>
      <Timeline store={store} />
      <Help store={store} />
    </>
  );
}
