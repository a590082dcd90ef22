import { render } from "preact";
import { pageAsItCame } from "./source/keep";
import { begin } from "./source/source";
import { Store } from "./store/store";
import { App } from "./view/app";

const page = pageAsItCame();
const store = new Store();
render(<App store={store} />, document.getElementById("app")!);
begin(store, page).catch((error: Error) => {
  store.trouble = `The run cannot be read: ${error.message}`;
  store.changed();
});
