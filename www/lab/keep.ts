/** The visitor's movements across visits, in this browser alone, if they ask for it. */
import type { Movement } from "./movement.ts";

/** Present while movements are kept. */
const FLAG = "whither-lab-keep";
const DATABASE = "whither-lab";
const STORE = "movements";

/** Whether the visitor has asked for it. */
export function isKeeping(): boolean {
  try {
    return localStorage.getItem(FLAG) !== null;
  } catch {
    return false;
  }
}

/** What was kept; nothing where nothing was. */
export async function kept(): Promise<Movement[]> {
  return isKeeping() ? withStore("readonly", (store) => store.getAll()) : [];
}

/** Keeps these, and from now on what `keepMore` is given. */
export async function keep(movements: readonly Movement[]): Promise<void> {
  localStorage.setItem(FLAG, "true");
  await keepMore(movements);
}

export async function keepMore(movements: readonly Movement[]): Promise<void> {
  if (!isKeeping() || movements.length === 0) return;
  await withStore("readwrite", (store) => {
    for (const movement of movements) store.add(movement);
    return store.count();
  });
}

/** Deletes all that was kept, and that it was asked for. */
export async function keepNothing(): Promise<void> {
  if (!isKeeping()) return;
  localStorage.removeItem(FLAG);
  await resultOf(indexedDB.deleteDatabase(DATABASE));
}

async function withStore<T>(mode: IDBTransactionMode, use: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const open = indexedDB.open(DATABASE, 1);
  open.onupgradeneeded = () => open.result.createObjectStore(STORE, { autoIncrement: true });
  const database = await resultOf(open);
  try {
    return await resultOf(use(database.transaction(STORE, mode).objectStore(STORE)));
  } finally {
    database.close();
  }
}

function resultOf<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error ?? new Error("the browser does not store it"));
  });
}
