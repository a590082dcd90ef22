import { useEffect } from "preact/hooks";
import { Header } from "./header";
import { globalKey } from "./keys";
import { Now } from "./now";
import { useStore, type Store } from "./store";
import { Timeline } from "./timeline/timeline";
import { Tree } from "./tree/tree";

export function App({ store }: { store: Store }) {
  const looking = useStore(store);
  useEffect(() => {
    document.documentElement.dataset.theme = looking.theme;
  }, [looking.theme]);
  useEffect(() => {
    document.title = `${store.run.header?.tree ?? "run"} · lockstep`;
  }, [store.run.header]);
  useEffect(() => {
    const key = (event: KeyboardEvent) => globalKey(store, event);
    addEventListener("keydown", key);
    return () => removeEventListener("keydown", key);
  }, [store]);
  if (store.run.lines === 0) return <main class="empty"><p role="status">{store.trouble || "Reading the run …"}</p></main>;
  return (
    <>
      <Header store={store} />
      {store.trouble && <p class="trouble" role="alert">{store.trouble}</p>}
      <main>
        <Tree store={store} looking={looking} />
        <aside aria-label="About this moment"><Now store={store} /></aside>
      </main>
      <Timeline store={store} />
    </>
  );
}
