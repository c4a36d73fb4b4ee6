/** What the car's screen offers: 21 places, in reading order. */
import {
  Bluetooth,
  CalendarDays,
  Camera,
  CircleQuestionMark,
  CircleUserRound,
  CloudSun,
  Fan,
  Fuel,
  LayoutGrid,
  MessageSquare,
  Music,
  Navigation,
  Phone,
  RadioTower,
  Route,
  SlidersHorizontal,
  type IconNode,
} from "lucide";
import { DippedBeam, ParkingAid, Seat, SteeringWheel, TyrePressure } from "./icons.ts";

export interface Place {
  readonly id: string;
  readonly label: string;
  readonly icon: IconNode;
}

export const PLACES: readonly Place[] = [
  { id: "navigation", label: "Navigation", icon: Navigation },
  { id: "phone", label: "Phone", icon: Phone },
  { id: "radio", label: "Radio", icon: RadioTower },
  { id: "media", label: "Media", icon: Music },
  { id: "climate", label: "Climate", icon: Fan },
  { id: "seats", label: "Seats", icon: Seat },
  { id: "camera", label: "Camera", icon: Camera },
  { id: "parking", label: "Parking", icon: ParkingAid },
  { id: "drive-mode", label: "Drive mode", icon: SteeringWheel },
  { id: "lights", label: "Lights", icon: DippedBeam },
  { id: "apps", label: "Apps", icon: LayoutGrid },
  { id: "messages", label: "Messages", icon: MessageSquare },
  { id: "calendar", label: "Calendar", icon: CalendarDays },
  { id: "weather", label: "Weather", icon: CloudSun },
  { id: "fuel", label: "Fuel", icon: Fuel },
  { id: "tyres", label: "Tyres", icon: TyrePressure },
  { id: "trip", label: "Trip", icon: Route },
  { id: "profile", label: "Profile", icon: CircleUserRound },
  { id: "connections", label: "Connections", icon: Bluetooth },
  { id: "settings", label: "Settings", icon: SlidersHorizontal },
  { id: "help", label: "Help", icon: CircleQuestionMark },
];
